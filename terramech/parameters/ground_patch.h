#pragma once

#include <array>
#include <cmath>
#include <cstdint>

namespace regoplan {

/// Most wheels that a vehicle may have.
inline constexpr std::size_t kMaxWheels = 8;

/// The ground under a vehicle: the plane through its wheels' contacts, and each wheel's soil. Told
/// in the vehicle's heading: forward is the horizontal direction of its heading, left across it.
struct GroundPatch {
  bool known = false;        ///< height and an allowed soil are known under every wheel
  double z_m = 0;            ///< of the plane, below the centre of gravity
  double slope_forward = 0;  ///< dz over horizontal distance, forward
  double slope_left = 0;     ///< and to the left
  /// Of the ground along the heading, positive where it is hollow: what presses a vehicle into dips
  /// at speed, and lifts it off crests.
  double curvature_1pm = 0;
  std::array<std::int16_t, kMaxWheels> soil{};  ///< of each wheel, in the vehicle's order

  /// Angle between the plane and the horizontal.
  double tilt_rad() const { return std::atan(std::hypot(slope_forward, slope_left)); }
};

/// Axes of a vehicle that stands on a patch: x along its heading in the plane, y left in the plane.
/// Gives gravity in these axes and turns body velocities into velocities on the map.
struct PatchAxes {
  double gravity_forward_mps2 = 0;
  double gravity_left_mps2 = 0;
  double gravity_normal_mps2 = 0;  ///< into the ground, positive
  double forward_per_vx = 1;       ///< horizontal forward velocity per body vx
  double forward_per_vy = 0;       ///< horizontal forward velocity per body vy
  double left_per_vy = 1;          ///< horizontal velocity to the left per body vy
  double yaw_per_turn = 1;         ///< rate of the heading per turning rate about the normal

  PatchAxes(const GroundPatch& patch, double gravity_mps2) {
    const double p = patch.slope_forward, q = patch.slope_left;
    const double along = std::sqrt(1 + p * p);                   // |(1, 0, p)|
    const double per_along = 1 / along;                          // divisions are dear
    const double per_normal = 1 / std::sqrt(1 + p * p + q * q);  // |(-p, -q, 1)|
    gravity_forward_mps2 = -gravity_mps2 * p * per_along;
    gravity_left_mps2 = -gravity_mps2 * q * (per_normal * per_along);
    gravity_normal_mps2 = gravity_mps2 * per_normal;
    forward_per_vx = per_along;
    forward_per_vy = -p * q * (per_normal * per_along);
    left_per_vy = along * per_normal;
    yaw_per_turn = along * along * per_normal;
  }
};

}  // namespace regoplan
