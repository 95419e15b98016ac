#pragma once

#include <optional>

#include "terramech/mechanisms/mechanism_effects.h"
#include "terramech/wheel/wheel_contact.h"

namespace regoplan::wheel_contact {

/// The stress under a wheel where a mechanism changes its law.
struct StressLaw {
  ShearLaw shear = ShearLaw::kSeparate;
  double residual = 1;   ///< kHump: residual over peak; kSoftening: over tau_max
  double softening = 1;  ///< kSoftening: displacement over kx, ky at which 1 - 1/e is lost
  double coupling = 1;   ///< kWithinLimit: how far shares are cut back, 1 at the limit
  Layering layering;
};

/// Integrals and side force under such a law; |Fy| is split like the other forces.
struct LawIntegrals {
  Integrals plane;
  double fu_cohesion_n = 0, fu_stress_n = 0;
};

/// As `integrate`, for any law, and for the base model's where its corners are sharp: the contact
/// is also split where jx = 0 or the rim's velocity through the soil turns over.
LawIntegrals integrate_with_law(const Ground& ground, const Contact& contact, const Ratios& ratios,
                                const StressLaw& law, WheelAccuracy accuracy);

/// The entry angle that carries the load with Q = 1 under such a law: secant steps from a guess,
/// where these do not end, the first crossing outward from it. Nothing where none carries it.
std::optional<double> entry_angle_with_law(const Ground& ground, double load_n,
                                           const Ratios& ratios, const StressLaw& law,
                                           WheelAccuracy accuracy, double guess_rad);

}  // namespace regoplan::wheel_contact
