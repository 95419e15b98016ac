#pragma once

#include <cmath>
#include <numbers>

namespace regoplan {

/// Radians in a degree.
inline constexpr double kDegree = std::numbers::pi / 180;

/// Radians in a right angle.
inline constexpr double kQuarterTurn = std::numbers::pi / 2;

/// An angle in degrees, as people read it.
constexpr double degrees(double angle_rad) {
  return angle_rad * (180 / std::numbers::pi);
}

/// Rounded far below any meaning, so that a limit given as 60 deg is 60 deg again.
inline double rounded_degrees(double angle_rad) {
  return std::round(angle_rad / kDegree * 1e9) / 1e9;
}

}  // namespace regoplan
