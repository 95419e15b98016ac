#pragma once

#include <functional>
#include <span>
#include <vector>

#include "terramech/ground_patch.h"
#include "terramech/steered_wheel.h"
#include "terramech/vehicle.h"
#include "terramech/wheel_law.h"
#include "terramech/wheel_loads.h"

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
};

/// Targets that the rim speed and the steering move to at the vehicle's limited rates.
struct VehicleControl {
  double speed_target_mps = 0;
  double curvature_target_1pm = 0;
};

/// The largest strains on the wheels at the end of a step.
struct WheelStrain {
  double slip = 0;            ///< largest by magnitude, signed
  double slip_angle_rad = 0;  ///< largest by magnitude, signed
  double sinkage_m = 0;       ///< the wheel's radius where one sinks to its axle
  double load_min_n = 0;      ///< 0 or less: a wheel lifts
};

/// What a step leads to.
struct StepResult {
  VehicleState state;
  WheelStrain strain;
  double drive_energy_j = 0;  ///< torque times turning rate of the wheels that drive
  bool on_known_ground = true;
  bool converged = true;  ///< false: no step size balanced the forces; the state is the last good
};

/// Planar rigid-body dynamics of a vehicle on its terrain, with the wheel model's forces at every
/// wheel: loads by `LoadSharing`, slip ratio and slip angle by rigid-body kinematics at the
/// contact, soil of the map under each wheel.
///
///   m (dvx/dt - vy r) = sum Fx + m g_x,  m (dvy/dt + vx r) = sum Fy + m g_y,  I dr/dt = sum M
///
/// Integrated by the two-stage, second-order, L-stable singly diagonally implicit Runge-Kutta
/// method (Alexander 1977; gamma = 1 - 1/sqrt 2), because the lateral equations grow stiff as
/// 1/speed. Load transfer follows the wheels' forces with a delay of `kTransferTime_s`. Below about
/// 1 mm/s the forces fade with the speed (`kStandstillSpeed_mps`): a vehicle with locked wheels
/// creeps where friction would hold it, slower than that where it takes less than half of the
/// friction there is. Deterministic; const and safe from many threads where the ground is.
class VehicleDynamics {
 public:
  using Ground = std::function<GroundPatch(double x_m, double y_m, double yaw_rad)>;

  static constexpr double kTransferTime_s = 0.1;
  static constexpr double kStandstillSpeed_mps = 1e-3;

  /// \param soil_laws the wheel's forces on each soil, by the ground's soil indices; like vehicle
  /// and ground they must outlive this
  VehicleDynamics(const Vehicle& vehicle, std::span<const WheelLaw> soil_laws, Ground ground,
                  double gravity_mps2);

  /// The state after `duration_s` under a constant control. Second order in the duration.
  StepResult step(const VehicleState& state, const VehicleControl& control,
                  double duration_s) const;

  /// A state that starts at the given pose, rolling without slip at the given speed.
  VehicleState rolling_state(double x_m, double y_m, double yaw_rad, double speed_mps,
                             double curvature_1pm = 0) const;

  GroundPatch ground(double x_m, double y_m, double yaw_rad) const {
    return ground_(x_m, y_m, yaw_rad);
  }
  const Vehicle& vehicle() const { return vehicle_; }
  const LoadSharing& sharing() const { return sharing_; }
  double gravity_mps2() const { return gravity_mps2_; }

 private:
  struct Stage;
  struct Velocities;
  struct WheelSums;

  WheelSums wheel_sums(const BodyMotion& motion, const Stage& stage, double transfer_forward_n,
                       double transfer_left_n, bool with_slopes) const;
  bool solve_stage(Stage& stage) const;
  StepResult try_step(const VehicleState& state, const VehicleControl& control,
                      double duration_s) const;

  const Vehicle& vehicle_;
  std::span<const WheelLaw> soil_laws_;
  Ground ground_;
  LoadSharing sharing_;
  double gravity_mps2_;
};

}  // namespace regoplan
