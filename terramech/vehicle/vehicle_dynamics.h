#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "terramech/parameters/ground_patch.h"
#include "terramech/parameters/vehicle.h"
#include "terramech/vehicle/steered_wheel.h"
#include "terramech/vehicle/wheel_loads.h"
#include "terramech/vehicle/wheel_sums.h"
#include "terramech/wheel/wheel_law.h"

namespace regoplan {

/// A vehicle on a terrain. Map frame: x east, y north; body frame: x forward, y left, in the plane
/// of the ground under the vehicle.
struct VehicleState {
  double x_m = 0;  ///< of the ground point below the centre of gravity
  double y_m = 0;
  double yaw_rad = 0;  ///< heading from +x toward +y
  BodyMotion motion;
  double curvature_1pm = 0;          ///< commanded: what the steering is set for
  double rim_speed_mps = 0;          ///< commanded: rim speed of slip-free driving
  double rim_acceleration_mps2 = 0;  ///< commanded, of the step that led here
  double transfer_forward_n = 0;     ///< force that the load transfer has settled to
  double transfer_left_n = 0;
  double crab_rad = 0;         ///< commanded: direction of travel beside that of the curvature
  double turn_rate_rad_s = 0;  ///< commanded: rotation on the spot; then the rim speed is 0
  /// Of rims that stand: 1 where they came to rest or are to set off forward, -1 backward, 0 where
  /// nothing tells.
  int direction_at_rest = 0;
};

/// Targets that the rim speed and the steering move to at the vehicle's limited rates: the crab
/// angle at that of the steering, `curvature_rate_max_1pms` times the longest arm of a wheel.
struct VehicleControl {
  double speed_target_mps = 0;
  double curvature_target_1pm = 0;
  double crab_target_rad = 0;
  /// Other than 0, the vehicle brakes to a stop, sets its wheels for turning on the spot (in no
  /// time, at rest) and turns; at 0 it stops turning first. \pre 0 or `can_turn_on_the_spot`
  double turn_rate_target_rad_s = 0;
};

/// What a step leads to.
struct StepResult {
  VehicleState state;
  WheelStrain strain;  ///< at the end of the step
  /// Torque times turning rate of each wheel where that is above 0: braking gives nothing back.
  double drive_energy_j = 0;
  bool on_known_ground = true;
  bool converged = true;  ///< false: no step size balanced the forces; the state is the last good
};

/// Planar rigid-body dynamics of a vehicle on its terrain, with the wheel model's forces at every
/// wheel: loads by `LoadSharing`, slip ratio and slip angle by rigid-body kinematics at the
/// contact, soil of the map under each wheel. The loads' sum is m (g_n + vx^2 k) on ground of
/// curvature k along the heading; where that is not above 0, the wheels have no forces.
///
///   m (dvx/dt - vy r) = sum Fx + m g_x,  m (dvy/dt + vx r) = sum Fy + m g_y,  I dr/dt = sum M
///
/// Rims turn as the drive law and the motors' torque limit have it (`VehicleWheels`).
///
/// Integrated implicitly, because the lateral equations grow stiff as 1/speed, by either of two
/// methods of second order that are L-stable: where every wheel rolls at its commanded speed and
/// the step's own error estimate is small, ROS2, a linearly implicit W-method of two stages (Verwer
/// et al. 1999; gamma = 1 - 1/sqrt 2); else the two-stage singly diagonally implicit Runge-Kutta
/// method (Alexander 1977; the same gamma), whose stages Newton's method solves. Load transfer
/// follows the wheels' forces with a delay of `kTransferTime_s`. Below about
/// 1 mm/s the forces fade with the speed (`kStandstillSpeed_mps`): a vehicle with locked wheels
/// creeps where friction would hold it, slower than that where it takes less than 0.7 of the
/// friction there is. Deterministic; const and safe from many threads where the ground is.
class VehicleDynamics {
 public:
  using Ground = std::function<GroundPatch(double x_m, double y_m, double yaw_rad)>;

  static constexpr double kTransferTime_s = 0.1;
  static constexpr double kStandstillSpeed_mps = VehicleWheels::kStandstillSpeed_mps;

  /// \param soil_laws the wheel's forces on each soil, by the ground's soil indices; like vehicle
  /// and ground they must outlive this
  /// \throws ValueError or InputError for a mass, an inertia, an acceleration, a wheel or a gravity
  /// that cannot be, wheels that the vehicle does not stand on, no soil law; the rest of a vehicle
  /// is for `validate` to ask
  VehicleDynamics(const Vehicle& vehicle, std::span<const WheelLaw> soil_laws, Ground ground,
                  double gravity_mps2);
  VehicleDynamics(Vehicle&& gone, std::span<const WheelLaw> soil_laws, Ground ground,
                  double gravity_mps2) = delete;
  VehicleDynamics(const Vehicle& vehicle, std::vector<WheelLaw>&& gone, Ground ground,
                  double gravity_mps2) = delete;

  /// The state after `duration_s` under a constant control. Second order in the duration.
  StepResult step(const VehicleState& state, const VehicleControl& control,
                  double duration_s) const;

  /// A state that starts at the given pose, rolling without slip at the given speed.
  VehicleState rolling_state(double x_m, double y_m, double yaw_rad, double speed_mps,
                             double curvature_1pm = 0, double crab_rad = 0) const;

  /// Whether a vehicle stands: its wheels are commanded to stand still, and none moves faster than
  /// `kStandstillSpeed_mps`. What motion is left is the creep that stands for static friction.
  bool at_rest(const VehicleState& state) const;

  GroundPatch ground(double x_m, double y_m, double yaw_rad) const {
    return ground_(x_m, y_m, yaw_rad);
  }
  const Vehicle& vehicle() const { return vehicle_; }
  const LoadSharing& sharing() const { return wheels_.sharing(); }
  double gravity_mps2() const { return gravity_mps2_; }

 private:
  struct Commands;
  struct Stage;
  struct TriedStep {
    StepResult result;
    bool overshoots = false;  ///< its extrapolated stage passed what the vehicle settles to
  };
  /// Of the commanded speed: how far the linearly implicit step may be from one of first order.
  static constexpr double kSmoothShare = 0.05;
  /// Of the speed: how far a step may end beyond what the vehicle settles to faster than the step.
  static constexpr double kBeyondShare = 0.02;

  Commands commands_after(const VehicleState& state, const VehicleControl& control,
                          double duration_s) const;
  WheelSetting setting(const Commands& commands) const;
  GroundReaction reaction(const GroundPatch& patch, const PatchAxes& axes, double vx_mps,
                          double transfer_forward_n, double transfer_left_n) const;
  std::optional<StepResult> linearly_implicit_step(const VehicleState& state,
                                                   const VehicleControl& control,
                                                   double duration_s) const;
  bool solve_stage(Stage& stage) const;
  bool overshoots(const Eigen::Vector3d& start, const Stage& first, const Stage& second) const;
  TriedStep implicit_step(const VehicleState& state, const VehicleControl& control,
                          double duration_s) const;
  TriedStep try_step(const VehicleState& state, const VehicleControl& control,
                     double duration_s) const;

  const Vehicle& vehicle_;
  VehicleWheels wheels_;
  Ground ground_;
  double gravity_mps2_;
  double longest_arm_m_;
};

}  // namespace regoplan
