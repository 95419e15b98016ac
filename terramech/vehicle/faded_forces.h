#pragma once

#include <algorithm>
#include <cmath>

#include "terramech/wheel/wheel_law.h"

namespace regoplan {

/// Speed about which a wheel's forces fade: near standstill they vanish with the speed that they
/// oppose, because a locked wheel shears the soil fully whichever way it slides, and its forces
/// would jump.
inline constexpr double kStandstill_mps = 1e-3;

/// What makes forces vanish with the speed that they oppose, v/sqrt(v^2 + kStandstill_mps^2), and
/// its slope over the speed. It leaves rolling wheels alone: 0.03 % of the forces at 0.04 m/s,
/// where slow rovers drive. One root and one division: they are most of the cost.
struct Fade {
  double value, slope_per_speed;

  /// \param a_mps, b_mps components of the speed
  Fade(double a_mps, double b_mps) {
    constexpr double kStandstill_m2ps2 = kStandstill_mps * kStandstill_mps;
    constexpr double kLeast_m2ps2 = 1e-300;  // at rest all of it is 0
    const double square = a_mps * a_mps + b_mps * b_mps;
    const double per_both =
        1 / std::max(std::sqrt(square * (square + kStandstill_m2ps2)), kLeast_m2ps2);
    value = square * per_both;
    slope_per_speed = kStandstill_m2ps2 * per_both * (value * per_both);
  }
};

/// The wheel's forces, faded near standstill.
inline WheelForces faded(const WheelLaw& law, double load_n, const WheelMotion& at) {
  WheelForces forces = law.forces(load_n, at);
  const double fade_x = Fade(at.vx_mps, at.rim_speed_mps).value;
  forces.fx_n *= fade_x;
  forces.fy_n *= Fade(at.vy_mps, at.rim_speed_mps).value;
  forces.torque_nm *= fade_x;
  return forces;
}

}  // namespace regoplan
