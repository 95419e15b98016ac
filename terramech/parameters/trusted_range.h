#pragma once

#include <cmath>
#include <numbers>

namespace regoplan {

/// Where forces of the wheel model are trusted: beyond, a wheel all but stands, all but spins or
/// slides sideways, which the model was not made for (docs/limits.md).
inline constexpr double kTrustedSlip_min = -0.9, kTrustedSlip_max = 0.95;
inline constexpr double kTrustedSlipAngle_rad = std::numbers::pi / 3;

/// \param slip_angle_rad of either sign
inline bool is_trusted(double slip_ratio, double slip_angle_rad) {
  constexpr double kRounding = 1e-9;
  return slip_ratio >= kTrustedSlip_min - kRounding && slip_ratio <= kTrustedSlip_max + kRounding &&
         std::abs(slip_angle_rad) <= kTrustedSlipAngle_rad + kRounding;
}

}  // namespace regoplan
