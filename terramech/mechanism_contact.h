#pragma once

#include "terramech/mechanism_effects.h"
#include "terramech/wheel_contact.h"

namespace regoplan::wheel_contact {

/// Integrals and side force under a shear law that the base model does not have; |Fy| is split like
/// the other forces.
struct LawIntegrals {
  Integrals plane;
  double fu_cohesion_n = 0, fu_stress_n = 0;
};

/// The stress integrals in plain arithmetic, some thirty times slower than `integrate`, and for any
/// shear law.
LawIntegrals integrate_with_law(const Ground& ground, const Contact& contact, const Ratios& ratios,
                                ShearLaw law, double residual);

}  // namespace regoplan::wheel_contact
