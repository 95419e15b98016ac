#pragma once

#include <algorithm>
#include <cmath>

#include "terramech/wheel/wheel_law.h"

namespace regoplan {

/// Speed about which a wheel's forces fade: near standstill they vanish with the speed that they
/// oppose, because a locked wheel shears the soil fully whichever way it slides, and its forces
/// would jump.
inline constexpr double kStandstill_mps = 1e-3;

/// What makes forces vanish with the speed that they oppose, v/(v + kStandstill_mps), and its slope
/// over the speed. One division: they are most of the cost.
struct Fade {
  double value, slope_per_speed;

  /// \param a_mps, b_mps components of the speed
  Fade(double a_mps, double b_mps) {
    const double speed = std::sqrt(a_mps * a_mps + b_mps * b_mps), whole = speed + kStandstill_mps;
    constexpr double kLeast = 1e-300;  // at rest all of it is 0
    const double per_both = 1 / std::max(speed * whole, kLeast);
    const double per_whole = speed * per_both;
    value = speed * per_whole;
    slope_per_speed = kStandstill_mps * per_whole * per_both;
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
