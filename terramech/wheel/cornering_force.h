#pragma once

#include <cmath>

namespace regoplan {

/// A wheel's forces in the plane of the ground, turned from its own axes to its direction of
/// travel.
struct TravelForces {
  double cornering_n = 0;  ///< FC, on the wheel, to the right of its direction of travel
  double drag_n = 0;       ///< FB, on the wheel, along it: negative where the ground holds it back
};

/// Eqs. (18) and (19) of the paper.
/// \param fx_n, fy_n along and across the wheel, as in WheelForces; NaN goes into both
/// \param slip_angle_rad from the wheel's heading to its direction of travel, positive to the left
inline TravelForces travel_forces(double fx_n, double fy_n, double slip_angle_rad) {
  const double sine = std::sin(slip_angle_rad);
  const double cosine = std::cos(slip_angle_rad);
  return {.cornering_n = fx_n * sine + fy_n * cosine, .drag_n = fx_n * cosine - fy_n * sine};
}

}  // namespace regoplan
