#include "terramech/vehicle/vehicle_dynamics.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "terramech/basics/input_error.h"
#include "terramech/parameters/gravity_range.h"
#include "terramech/vehicle/step_commands.h"

namespace regoplan {
namespace {

/// Moves a value to a target at a limited rate.
double approach(double value, double target, double rate_max, double duration_s) {
  const double step = rate_max * duration_s;
  return std::abs(target - value) <= step ? target : value + std::copysign(step, target - value);
}

/// What the motion divides by and counts wheels by. A vehicle told from another centre of gravity
/// need not pass `validate` as a whole: it may be asked for turns that it cannot steer.
const Vehicle& checked(const Vehicle& vehicle, std::span<const WheelLaw> soil_laws) {
  require("mass_kg", vehicle.mass_kg, kVehicleMass_kg);
  require("yaw_inertia_kgm2", vehicle.yaw_inertia_kgm2, kVehicleYawInertia_kgm2);
  require("acceleration_max_mps2", vehicle.acceleration_max_mps2, kVehicleAcceleration_mps2);
  validate(vehicle.wheel);
  if (vehicle.wheels.size() < 3 || vehicle.wheels.size() > kMaxWheels ||
      !stands_on_wheels(vehicle)) {
    throw InputError(fmt::format(
        "wheels: 3 to {} that the centre of gravity (x_m = y_m = 0) stands between", kMaxWheels));
  }
  if (soil_laws.empty()) throw InputError("soil_laws: none; one for each soil of the ground");
  return vehicle;
}

double checked_gravity_mps2(double gravity_mps2) {
  require("gravity_mps2", gravity_mps2, kGravity_mps2);
  return gravity_mps2;
}

}  // namespace

VehicleDynamics::VehicleDynamics(const Vehicle& vehicle, std::span<const WheelLaw> soil_laws,
                                 Ground ground, double gravity_mps2)
    : vehicle_(checked(vehicle, soil_laws)),
      wheels_(vehicle, soil_laws),
      ground_(std::move(ground)),
      gravity_mps2_(checked_gravity_mps2(gravity_mps2)),
      longest_arm_m_(longest_arm_m(vehicle)) {}

VehicleDynamics::Commands VehicleDynamics::commands_after(const VehicleState& state,
                                                          const VehicleControl& control,
                                                          double duration_s) const {
  const double steering_rate = vehicle_.curvature_rate_max_1pms;
  const double acceleration = vehicle_.acceleration_max_mps2;
  const bool turns = state.turn_rate_rad_s != 0 || control.turn_rate_target_rad_s != 0;
  assert(!turns || can_turn_on_the_spot(vehicle_));
  const bool on_the_spot = turns && state.rim_speed_mps == 0;
  Commands commands{
      .steering = {.curvature_1pm = approach(state.curvature_1pm, control.curvature_target_1pm,
                                             steering_rate, duration_s),
                   .crab_rad = approach(state.crab_rad, control.crab_target_rad,
                                        steering_rate * longest_arm_m_, duration_s)},
      .rim_speed_mps = approach(state.rim_speed_mps, turns ? 0 : control.speed_target_mps,
                                acceleration, duration_s),
      .on_the_spot = on_the_spot};
  if (commands.rim_speed_mps == 0) {
    commands.direction_at_rest = state.rim_speed_mps == 0  ? state.direction_at_rest
                                 : state.rim_speed_mps > 0 ? 1
                                                           : -1;
  }
  if (on_the_spot) {
    commands.turn_rate_rad_s = approach(state.turn_rate_rad_s, control.turn_rate_target_rad_s,
                                        acceleration / longest_arm_m_, duration_s);
  }
  return commands;
}

WheelSetting VehicleDynamics::setting(const Commands& commands) const {
  if (commands.on_the_spot) {
    return {.wheels = wheels_on_the_spot(vehicle_), .rim_speed = commands.turn_rate_rad_s};
  }
  return {.wheels = steered_wheels(vehicle_, commands.steering),
          .rim_speed = commands.rim_speed_mps};
}

GroundReaction VehicleDynamics::reaction(const GroundPatch& patch, const PatchAxes& axes,
                                         double vx_mps, double transfer_forward_n,
                                         double transfer_left_n) const {
  return {.normal_n =
              vehicle_.mass_kg * (axes.gravity_normal_mps2 + vx_mps * vx_mps * patch.curvature_1pm),
          .forward_n = transfer_forward_n,
          .left_n = transfer_left_n};
}

VehicleDynamics::TriedStep VehicleDynamics::try_step(const VehicleState& state,
                                                     const VehicleControl& control,
                                                     double duration_s) const {
  if (const auto result = linearly_implicit_step(state, control, duration_s)) return {*result};
  return implicit_step(state, control, duration_s);
}

StepResult VehicleDynamics::step(const VehicleState& state, const VehicleControl& control,
                                 double duration_s) const {
  TriedStep whole = try_step(state, control, duration_s);
  StepResult& result = whole.result;
  if ((result.converged && !whole.overshoots) || !result.on_known_ground) return result;
  constexpr double kShortest_s = 1e-4;
  if (duration_s / 2 < kShortest_s) {
    if (!result.converged) result.state = state;
    return result;
  }
  const StepResult first = step(state, control, duration_s / 2);
  if (!first.converged || !first.on_known_ground) return first;
  StepResult second = step(first.state, control, duration_s / 2);
  second.drive_energy_j += first.drive_energy_j;
  return second;
}

bool VehicleDynamics::at_rest(const VehicleState& state) const {
  const BodyMotion& motion = state.motion;
  constexpr double kRounding_mps = 1e-9;  // of many small steps down to 0
  return std::abs(state.rim_speed_mps) + std::abs(state.turn_rate_rad_s) * longest_arm_m_ <=
             kRounding_mps &&
         std::hypot(motion.vx_mps, motion.vy_mps) +
                 std::abs(motion.yaw_rate_rad_s) * longest_arm_m_ <=
             kStandstillSpeed_mps;
}

VehicleState VehicleDynamics::rolling_state(double x_m, double y_m, double yaw_rad,
                                            double speed_mps, double curvature_1pm,
                                            double crab_rad) const {
  const double slip_free = kinematic_body_slip_angle_rad(vehicle_, curvature_1pm) + crab_rad;
  return {.x_m = x_m,
          .y_m = y_m,
          .yaw_rad = std::remainder(yaw_rad, 2 * std::numbers::pi),
          .motion = {.vx_mps = speed_mps * std::cos(slip_free),
                     .vy_mps = speed_mps * std::sin(slip_free),
                     .yaw_rate_rad_s = speed_mps * curvature_1pm},
          .curvature_1pm = curvature_1pm,
          .rim_speed_mps = speed_mps,
          .crab_rad = crab_rad};
}

}  // namespace regoplan
