#pragma once

#include <array>
#include <cmath>

#include "terramech/parameters/ground_patch.h"
#include "terramech/parameters/vehicle.h"
#include "terramech/wheel/wheel_model.h"

namespace regoplan {

/// What the steering is set for: slip-free rotation along a path of the given curvature, turned by
/// the crab angle. All wheels of a vehicle that crabs straight ahead are parallel.
struct SteeringCommand {
  double curvature_1pm = 0;  ///< of the path of the vehicle's origin, left positive
  double crab_rad = 0;       ///< turns the direction of travel in the vehicle, left positive
};

/// A wheel set by a command.
struct SteeredWheel {
  double cos_steer = 1, sin_steer = 0;
  double rim_speed_per_speed = 1;  ///< slip-free rim speed over the speed of the vehicle's origin

  double steer_rad() const { return std::atan2(sin_steer, cos_steer); }
};

/// Sets a wheel by the vehicle's steering geometry; its rim turns as slip-free rolling along its
/// heading would. Without steered wheels that is skid steering: rims on the left turn by 1 - k y.
/// Exactly odd under reflection (command and y change sign).
inline SteeredWheel steered_wheel(const Vehicle& vehicle, const WheelMount& mount,
                                  const SteeringCommand& command) {
  const double k = command.curvature_1pm, kx = k * vehicle.turn_centre_x_m;
  double forward = std::sqrt(1 - kx * kx), left = -kx;  // direction of travel of the origin
  if (command.crab_rad != 0) {
    const double c = std::cos(command.crab_rad), s = std::sin(command.crab_rad);
    const double straight = forward;
    forward = c * straight - s * left;
    left = s * straight + c * left;
  }
  const double vx = forward - k * mount.y_m, vy = left + k * mount.x_m;
  if (!mount.steered) return {.rim_speed_per_speed = vx};
  const double speed = std::sqrt(vx * vx + vy * vy);
  return {.cos_steer = vx / speed, .sin_steer = vy / speed, .rim_speed_per_speed = speed};
}

/// Sets a wheel for rotation on the spot about the point (turn_centre_x_m, 0), within a quarter
/// turn either way; `rim_speed_per_speed` is then per rad/s of that rotation, in metres, and
/// negative on the left.
SteeredWheel wheel_on_the_spot(const Vehicle& vehicle, const WheelMount& mount);

/// All wheels of a vehicle. Under equal speed the driven rims get the mean of what slip-free
/// rolling would have them turn.
std::array<SteeredWheel, kMaxWheels> steered_wheels(const Vehicle& vehicle,
                                                    const SteeringCommand& command);
std::array<SteeredWheel, kMaxWheels> wheels_on_the_spot(const Vehicle& vehicle);

/// Whether a vehicle can turn on the spot: every steered wheel reaches its angle, every other one
/// stands abreast of the centre or is dragged because the vehicle steers by skidding, and the drive
/// law is kinematic.
bool can_turn_on_the_spot(const Vehicle& vehicle);

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

/// Sums over the wheels of a vehicle, each side by itself and then the two: where both sides name
/// their wheels in the same order, the sums of mirrored motions mirror to the last bit.
/// \param add adds wheel i to a sum, add(sum, i)
template <class Sum, class Add>
[[gnu::always_inline]] inline Sum sum_by_side(const Vehicle& vehicle, const Sum& zero,
                                              const Add& add) {
  Sum left = zero, right = zero, between = zero;
  for (std::size_t i = 0; i < vehicle.wheels.size(); ++i) {
    const double y = vehicle.wheels[i].y_m;
    add(y > 0 ? left : y < 0 ? right : between, i);
  }
  return (left + right) + between;
}

/// Horizontal force and yaw moment on the vehicle's origin, body frame.
struct BodyForce {
  double forward_n = 0;
  double left_n = 0;
  double yaw_nm = 0;

  friend BodyForce operator+(const BodyForce& a, const BodyForce& b) {
    return {a.forward_n + b.forward_n, a.left_n + b.left_n, a.yaw_nm + b.yaw_nm};
  }

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
