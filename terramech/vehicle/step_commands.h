#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "terramech/vehicle/vehicle_dynamics.h"

namespace regoplan {

/// A heading within half a turn either way.
inline double wrapped_rad(double yaw_rad) {
  return std::abs(yaw_rad) <= std::numbers::pi ? yaw_rad
                                               : std::remainder(yaw_rad, 2 * std::numbers::pi);
}

/// What steering and motors are commanded at a moment.
struct VehicleDynamics::Commands {
  SteeringCommand steering;
  double rim_speed_mps = 0;
  bool on_the_spot = false;
  double turn_rate_rad_s = 0;
  int direction_at_rest = 0;

  bool differ_from(const Commands& other) const {
    return steering.curvature_1pm != other.steering.curvature_1pm ||
           steering.crab_rad != other.steering.crab_rad || rim_speed_mps != other.rim_speed_mps ||
           on_the_spot != other.on_the_spot || turn_rate_rad_s != other.turn_rate_rad_s;
  }

  /// The state at the end of a step that led to these commands.
  /// \param pose x, y, yaw on the map, the yaw within a turn
  /// \param transfer_n of load, forward and left
  VehicleState state(const Eigen::Vector3d& pose, const BodyMotion& motion,
                     const Eigen::Vector2d& transfer_n, double rim_acceleration_mps2) const {
    return {.x_m = pose[0],
            .y_m = pose[1],
            .yaw_rad = wrapped_rad(pose[2]),
            .motion = motion,
            .curvature_1pm = steering.curvature_1pm,
            .rim_speed_mps = rim_speed_mps,
            .rim_acceleration_mps2 = rim_acceleration_mps2,
            .transfer_forward_n = transfer_n[0],
            .transfer_left_n = transfer_n[1],
            .crab_rad = steering.crab_rad,
            .turn_rate_rad_s = turn_rate_rad_s,
            .direction_at_rest = direction_at_rest};
  }
};

/// gamma of both methods of integration.
inline constexpr double kGamma = 1 - std::numbers::sqrt2 / 2;

inline Eigen::Vector3d vector_of(const BodyMotion& motion) {
  return {motion.vx_mps, motion.vy_mps, motion.yaw_rate_rad_s};
}

inline BodyMotion motion_of(const Eigen::Vector3d& v) {
  return {.vx_mps = v[0], .vy_mps = v[1], .yaw_rate_rad_s = v[2]};
}

/// What turns body velocities into velocities on the map, (x, y, yaw).
class Drift {
 public:
  Drift(const PatchAxes& axes, double yaw_rad)
      : axes_(axes), cos_(std::cos(yaw_rad)), sin_(std::sin(yaw_rad)) {}
  Eigen::Vector3d operator()(const Eigen::Vector3d& v) const {
    const double forward = axes_.forward_per_vx * v[0] + axes_.forward_per_vy * v[1];
    const double left = axes_.left_per_vy * v[1];
    return {cos_ * forward - sin_ * left, sin_ * forward + cos_ * left, axes_.yaw_per_turn * v[2]};
  }

 private:
  const PatchAxes& axes_;
  double cos_, sin_;
};

/// Slopes of the body's accelerations by its velocities, from those of the wheels' forces.
inline Eigen::Matrix3d jacobian_of(const Eigen::Matrix3d& slopes, const Eigen::Vector3d& per_force,
                                   const Eigen::Vector3d& v) {
  Eigen::Matrix3d jacobian = per_force.asDiagonal() * slopes;
  jacobian(0, 1) += v[2];
  jacobian(0, 2) += v[1];
  jacobian(1, 0) -= v[2];
  jacobian(1, 2) -= v[0];
  return jacobian;
}

/// Accelerations of the body in its own turning axes.
inline Eigen::Vector3d acceleration_of(const BodyForce& force, const PatchAxes& axes,
                                       const Eigen::Vector3d& per_force, const Eigen::Vector3d& v) {
  return {force.forward_n * per_force[0] + axes.gravity_forward_mps2 + v[1] * v[2],
          force.left_n * per_force[1] + axes.gravity_left_mps2 - v[0] * v[2],
          force.yaw_nm * per_force[2]};
}

}  // namespace regoplan
