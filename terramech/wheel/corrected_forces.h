#pragma once

#include "terramech/mechanisms/generic_correction.h"
#include "terramech/wheel/sloped_forces.h"
#include "terramech/wheel/wheel_model.h"

namespace regoplan {

/// The forces of a wheel with a generic correction added: mirrored where the wheel goes backward or
/// drifts to the right. Where it was not learned the forces stay, and an `ok` becomes
/// `outside_correction`; wheels without forces, at standstill or with a rim that turns against the
/// travel stay as they are.
WheelForces corrected(const GenericCorrection& correction, double load_n, const WheelMotion& motion,
                      WheelForces forces);
SlopedForces corrected(const GenericCorrection& correction, double load_n,
                       const WheelMotion& motion, SlopedForces forces);

}  // namespace regoplan
