#pragma once

#include <Eigen/Core>
#include <deque>
#include <optional>

#include "planner/following/follower.h"
#include "terramech/vehicle/vehicle_dynamics.h"

namespace regoplan {

/// A pose as it is measured, some time ago. Parts that a sensor does not bring are missing.
struct PoseFix {
  double time_s = 0;  ///< when it was so
  std::optional<double> x_m, y_m, yaw_rad;
};

/// How far a fix may be off: standard deviations.
struct PoseNoise {
  double position_m = 0.02;
  double yaw_rad = 0.02;
};

/// Where the vehicle takes itself to be: dead reckoning by rim speeds and steering, put right by
/// pose fixes, which also tell how the wheels slip. An extended Kalman filter over position, yaw,
/// and what three slips are beyond those foreseen: speed over rim speed (as a factor), slip angle,
/// and curvature beyond the commanded one; these drift with the way as a random walk.
class PoseFilter {
 public:
  PoseFilter(const Vehicle& vehicle, const VehicleState& start, const PoseNoise& noise);

  /// A step with what was commanded at its end. \param measured_rim_mps slip-free speed that the
  /// wheels' measured speeds stand for \param yaw_rate_rad_s of a gyro, where there is one
  void predict(const VehicleState& commanded, const ForeseenSlip& foreseen, double measured_rim_mps,
               std::optional<double> yaw_rate_rad_s, double step_s);

  /// A fix, which may lie a few seconds back; one older than `kMemory_s` is left out.
  void correct(const PoseFix& fix);

  /// What followers see: pose, motion, commands.
  VehicleState state() const;

  static constexpr double kMemory_s = 10;

 private:
  using Vector = Eigen::Matrix<double, 6, 1>;
  using Matrix = Eigen::Matrix<double, 6, 6>;
  enum : Eigen::Index { kX, kY, kYaw, kSpeedRatio, kSlipAngle, kCurvature };

  double slip_free_angle_rad() const;
  void correct_one(Eigen::Index part, double innovation, double deviation);

  const Vehicle& vehicle_;
  PoseNoise noise_;
  Vector mean_;
  Matrix covariance_;
  VehicleState commanded_;
  ForeseenSlip foreseen_;
  double time_s_ = 0;
  double rim_mps_ = 0;
  std::optional<double> yaw_rate_rad_s_;
  struct Past {
    double time_s = 0;
    double x_m = 0, y_m = 0, yaw_rad = 0;
  };
  std::deque<Past> past_;  ///< predicted poses, corrected as the present one is
};

}  // namespace regoplan
