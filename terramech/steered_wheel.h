#pragma once

#include "terramech/vehicle.h"
#include "terramech/wheel_model.h"

namespace regoplan {

/// A wheel set for a commanded curvature.
struct SteeredWheel {
  double steer_rad = 0;
  double cos_steer = 1, sin_steer = 0;
  double rim_speed_per_speed = 1;  ///< slip-free rim speed over the speed of the vehicle's origin
};

/// Sets a wheel by the vehicle's steering geometry; its rim turns as slip-free rolling along its
/// heading would.
SteeredWheel steered_wheel(const Vehicle& vehicle, const WheelMount& mount, double curvature_1pm);

/// Velocity of the vehicle's origin and its turning, in the body frame.
struct BodyMotion {
  double vx_mps = 0;
  double vy_mps = 0;
  double yaw_rate_rad_s = 0;
};

/// Rigid-body motion of the wheel's contact, in the wheel's frame.
inline WheelMotion wheel_motion(const WheelMount& mount, const SteeredWheel& wheel,
                                const BodyMotion& body, double rim_speed_mps) {
  const double vx = body.vx_mps - body.yaw_rate_rad_s * mount.y_m;
  const double vy = body.vy_mps + body.yaw_rate_rad_s * mount.x_m;
  return {.vx_mps = wheel.cos_steer * vx + wheel.sin_steer * vy,
          .vy_mps = wheel.cos_steer * vy - wheel.sin_steer * vx,
          .rim_speed_mps = rim_speed_mps};
}

/// Horizontal force and yaw moment on the vehicle's origin, body frame.
struct BodyForce {
  double forward_n = 0;
  double left_n = 0;
  double yaw_nm = 0;

  /// Adds a wheel's force (fx, -fy), turned from its heading into the body frame.
  void add(const WheelMount& mount, const SteeredWheel& wheel, const WheelForces& forces) {
    const double forward = wheel.cos_steer * forces.fx_n + wheel.sin_steer * forces.fy_n;
    const double left = wheel.sin_steer * forces.fx_n - wheel.cos_steer * forces.fy_n;
    forward_n += forward;
    left_n += left;
    yaw_nm += mount.x_m * left - mount.y_m * forward;
  }
};

}  // namespace regoplan
