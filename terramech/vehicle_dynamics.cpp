#include "terramech/vehicle_dynamics.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace regoplan {
namespace {

/// Alexander's two-stage method: y1 = y0 + (1 - gamma) h K1 + gamma h K2, both stages implicit in
/// gamma h, the second at the end of the step.
constexpr double kGamma = 1 - std::numbers::sqrt2 / 2;

/// Moves a value to a target at a limited rate.
double approach(double value, double target, double rate_max, double duration_s) {
  const double step = rate_max * duration_s;
  return std::abs(target - value) <= step ? target : value + std::copysign(step, target - value);
}

/// What makes forces vanish with the speed that they oppose. A locked wheel shears the soil fully
/// along either axis of its own, whichever way it slides: without this its forces would jump.
double fade(double speed_mps) {
  return speed_mps / (speed_mps + VehicleDynamics::kStandstillSpeed_mps);
}

Eigen::Vector3d vector_of(const BodyMotion& motion) {
  return {motion.vx_mps, motion.vy_mps, motion.yaw_rate_rad_s};
}

BodyMotion motion_of(const Eigen::Vector3d& v) {
  return {.vx_mps = v[0], .vy_mps = v[1], .yaw_rate_rad_s = v[2]};
}

}  // namespace

/// One implicit stage: velocities v with v = base + step dv/dt(v), everything else given.
struct VehicleDynamics::Stage {
  GroundPatch patch;
  std::array<SteeredWheel, kMaxWheels> wheels;
  double rim_speed_mps = 0;
  Eigen::Vector3d base;
  double step_s = 0;
  std::optional<Eigen::PartialPivLU<Eigen::Matrix3d>> newton;  ///< of a stage nearby
  double transfer_forward_base_n = 0, transfer_left_base_n = 0;

  // the solution
  Eigen::Vector3d velocity;
  Eigen::Vector3d acceleration;
  double transfer_forward_n = 0, transfer_left_n = 0;
  WheelStrain strain;
  double drive_power_w = 0;
};

/// The wheels' forces, summed in the body frame, with their slopes over (vx, vy, r).
struct VehicleDynamics::WheelSums {
  BodyForce force;
  Eigen::Matrix3d slopes = Eigen::Matrix3d::Zero();
  WheelStrain strain;
  double drive_power_w = 0;
};

VehicleDynamics::VehicleDynamics(const Vehicle& vehicle, std::span<const WheelLaw> soil_laws,
                                 Ground ground, double gravity_mps2)
    : vehicle_(vehicle),
      soil_laws_(soil_laws),
      ground_(std::move(ground)),
      sharing_(vehicle),
      gravity_mps2_(gravity_mps2) {}

VehicleDynamics::WheelSums VehicleDynamics::wheel_sums(const BodyMotion& motion, const Stage& stage,
                                                       double transfer_forward_n,
                                                       double transfer_left_n,
                                                       bool with_slopes) const {
  const PatchAxes axes(stage.patch, gravity_mps2_);
  const GroundReaction reaction{.normal_n = vehicle_.mass_kg * axes.gravity_normal_mps2,
                                .forward_n = transfer_forward_n,
                                .left_n = transfer_left_n};
  WheelSums sums;
  sums.strain.load_min_n = reaction.normal_n;
  for (std::size_t i = 0; i < vehicle_.wheels.size(); ++i) {
    const WheelMount& mount = vehicle_.wheels[i];
    const double load = sharing_.load_n(i, reaction);
    sums.strain.load_min_n = std::min(sums.strain.load_min_n, load);
    if (!(load > 0)) continue;
    const WheelLaw& law = soil_laws_[static_cast<std::size_t>(stage.patch.soil[i])];
    const SteeredWheel& wheel = stage.wheels[i];
    const WheelMotion at =
        wheel_motion(mount, wheel, motion, stage.rim_speed_mps * wheel.rim_speed_per_speed);
    const auto faded = [&](const WheelMotion& m) {
      WheelForces forces = law.forces(load, m);
      const double fade_x = fade(std::hypot(m.vx_mps, m.rim_speed_mps));
      forces.fx_n *= fade_x;
      forces.fy_n *= fade(std::hypot(m.vy_mps, m.rim_speed_mps));
      forces.torque_nm *= fade_x;
      return forces;
    };
    const WheelForces forces = faded(at);
    sums.force.add(mount, wheel, forces);

    const bool sunk = !has_forces(forces.status);
    const double sinkage = sunk ? vehicle_.wheel.radius_m : forces.sinkage_m;
    sums.strain.sinkage_m = std::max(sums.strain.sinkage_m, sinkage);
    const bool moves = std::max(std::hypot(at.vx_mps, at.vy_mps), std::abs(at.rim_speed_mps)) >
                       kStandstillSpeed_mps;
    if (moves) {
      const double slip = slip_ratio(at), slip_angle = slip_angle_rad(at);
      if (std::abs(slip) > std::abs(sums.strain.slip)) sums.strain.slip = slip;
      if (std::abs(slip_angle) > std::abs(sums.strain.slip_angle_rad)) {
        sums.strain.slip_angle_rad = slip_angle;
      }
    }
    sums.drive_power_w +=
        std::max(forces.torque_nm * at.rim_speed_mps / vehicle_.wheel.radius_m, 0.0);

    if (!with_slopes) continue;
    // d(force, moment)/d(vx, vy, r) = lever * turn * d(fx, -fy)/d(wheel velocity) * turn' * lever'
    const double h = 1e-4 * std::max({std::abs(at.vx_mps), std::abs(at.vy_mps),
                                      std::abs(at.rim_speed_mps), kStandstillSpeed_mps});
    const WheelForces ahead = faded({at.vx_mps + h, at.vy_mps, at.rim_speed_mps});
    const WheelForces aside = faded({at.vx_mps, at.vy_mps + h, at.rim_speed_mps});
    Eigen::Matrix2d slope;
    slope << ahead.fx_n - forces.fx_n, aside.fx_n - forces.fx_n,  //
        forces.fy_n - ahead.fy_n, forces.fy_n - aside.fy_n;
    slope /= h;
    Eigen::Matrix2d turn;
    turn << wheel.cos_steer, -wheel.sin_steer, wheel.sin_steer, wheel.cos_steer;
    Eigen::Matrix<double, 3, 2> lever;
    lever << 1, 0, 0, 1, -mount.y_m, mount.x_m;
    const Eigen::Matrix<double, 3, 2> turned = lever * turn;
    sums.slopes += turned * slope * turned.transpose();
  }
  return sums;
}

bool VehicleDynamics::solve_stage(Stage& stage) const {
  const PatchAxes axes(stage.patch, gravity_mps2_);
  const double m = vehicle_.mass_kg, inertia = vehicle_.yaw_inertia_kgm2;
  const Eigen::Vector3d per_force{1 / m, 1 / m, 1 / inertia};
  const double h = stage.step_s;
  const double lag = h / (h + kTransferTime_s);
  const Eigen::Vector3d in_mps{1, 1, std::sqrt(inertia / m)};
  double error_before = 0, missing_before = 0;
  bool slows = false;
  Eigen::Vector3d velocity_before = stage.velocity;
  int halvings = 0;
  for (int iteration = 0; iteration < 40; ++iteration) {
    // The slopes are dear: taken anew only where the old ones slow the convergence down.
    const bool with_slopes = !stage.newton || slows;
    const Eigen::Vector3d& v = stage.velocity;
    const WheelSums sums = wheel_sums(motion_of(v), stage, stage.transfer_forward_n,
                                      stage.transfer_left_n, with_slopes);
    const BodyForce& f = sums.force;
    stage.acceleration = {f.forward_n / m + axes.gravity_forward_mps2 + v[1] * v[2],
                          f.left_n / m + axes.gravity_left_mps2 - v[0] * v[2], f.yaw_nm / inertia};
    const double transfer_forward =
        stage.transfer_forward_base_n + lag * (f.forward_n - stage.transfer_forward_base_n);
    const double transfer_left =
        stage.transfer_left_base_n + lag * (f.left_n - stage.transfer_left_base_n);
    const double transfer_error = std::max(std::abs(transfer_forward - stage.transfer_forward_n),
                                           std::abs(transfer_left - stage.transfer_left_n)) /
                                  (m * axes.gravity_normal_mps2);
    stage.transfer_forward_n = transfer_forward;
    stage.transfer_left_n = transfer_left;
    stage.strain = sums.strain;
    stage.drive_power_w = sums.drive_power_w;

    const Eigen::Vector3d missing = stage.base + h * stage.acceleration - v;
    const double missing_mps = missing.cwiseProduct(in_mps).norm();
    if (iteration > 0 && missing_mps > missing_before && halvings < 10) {
      // Sliding friction saturates: a whole step may only change the direction of the slide.
      ++halvings;
      slows = true;
      stage.velocity = (stage.velocity + velocity_before) / 2;
      // All but at rest, the balance may lie on a jump of the forces: where a wheel that turns
      // stops moving, it spins on the one side and counter-rotates on the other.
      constexpr double kNearRest_mps = kStandstillSpeed_mps, kJump_mps = 1e-2 * kNearRest_mps;
      const Eigen::Vector3d apart = stage.velocity - velocity_before;
      if (velocity_before.cwiseProduct(in_mps).norm() < kNearRest_mps &&
          apart.cwiseProduct(in_mps).norm() < kJump_mps) {
        return true;
      }
      continue;
    }
    halvings = 0;
    missing_before = missing_mps;
    velocity_before = v;
    if (with_slopes) {
      Eigen::Matrix3d jacobian = per_force.asDiagonal() * sums.slopes;
      jacobian(0, 1) += v[2];
      jacobian(0, 2) += v[1];
      jacobian(1, 0) -= v[2];
      jacobian(1, 2) -= v[0];
      stage.newton = (Eigen::Matrix3d::Identity() - h * jacobian).partialPivLu();
    }
    const Eigen::Vector3d change = stage.newton->solve(missing);
    if (!change.allFinite()) return false;
    const double scale =
        std::max({std::abs(v[0]), std::abs(stage.rim_speed_mps), kStandstillSpeed_mps});
    const double error = change.cwiseAbs().maxCoeff() / scale;
    constexpr double kConverged = 1e-6, kAccepted = 3e-5;
    stage.velocity += change;
    const bool settled = transfer_error < 1e-6;
    if (error < kConverged && settled) return true;
    slows = iteration > 0 && error > 0.25 * error_before;
    if (iteration > 6 && slows && error < kAccepted) return true;
    error_before = error;
  }
  return false;
}

StepResult VehicleDynamics::try_step(const VehicleState& state, const VehicleControl& control,
                                     double duration_s) const {
  const double h = duration_s;
  const auto rim_at = [&](double t) {
    return approach(state.rim_speed_mps, control.speed_target_mps, vehicle_.acceleration_max_mps2,
                    t);
  };
  const auto curvature_at = [&](double t) {
    return approach(state.curvature_1pm, control.curvature_target_1pm,
                    vehicle_.curvature_rate_max_1pms, t);
  };
  const auto drift = [&](const PatchAxes& axes, const Eigen::Vector3d& v, double yaw) {
    const double forward = axes.forward_per_vx * v[0] + axes.forward_per_vy * v[1];
    const double left = axes.left_per_vy * v[1];
    const double c = std::cos(yaw), s = std::sin(yaw);
    return Eigen::Vector3d{c * forward - s * left, s * forward + c * left,
                           axes.yaw_per_turn * v[2]};
  };

  const auto steered_at = [&](double curvature_1pm) {
    std::array<SteeredWheel, kMaxWheels> wheels;
    for (std::size_t i = 0; i < vehicle_.wheels.size(); ++i) {
      wheels[i] = steered_wheel(vehicle_, vehicle_.wheels[i], curvature_1pm);
    }
    return wheels;
  };

  StepResult result{.state = state, .strain = {}};
  const Eigen::Vector3d pose{state.x_m, state.y_m, state.yaw_rad};
  const Eigen::Vector3d velocity = vector_of(state.motion);
  const GroundPatch here = ground_(pose[0], pose[1], pose[2]);
  if (!here.known) {
    result.on_known_ground = false;
    return result;
  }

  std::optional<Eigen::PartialPivLU<Eigen::Matrix3d>> newton;
  // Velocities are solved implicitly; poses, which are not stiff, follow with the ground taken at a
  // prediction of second order.
  const auto run_stage = [&](double at_s, const Eigen::Vector3d& base, double forward_base_n,
                             double left_base_n, const Eigen::Vector3d& guess,
                             const Eigen::Vector3d& pose_there) {
    Stage stage{.patch = ground_(pose_there[0], pose_there[1], pose_there[2]),
                .wheels = steered_at(curvature_at(at_s)),
                .rim_speed_mps = rim_at(at_s),
                .base = base,
                .step_s = kGamma * h,
                .newton = newton,
                .transfer_forward_base_n = forward_base_n,
                .transfer_left_base_n = left_base_n,
                .velocity = guess,
                .acceleration = Eigen::Vector3d::Zero(),
                .transfer_forward_n = forward_base_n,
                .transfer_left_n = left_base_n,
                .strain = {},
                .drive_power_w = 0};
    result.on_known_ground = stage.patch.known;
    result.converged = stage.patch.known && solve_stage(stage);
    newton = stage.newton;
    return stage;
  };
  // Guess that slip and side slip stay as they are while the rims speed up.
  const auto guess_at = [&](double at_s) {
    const double faster = rim_at(at_s) - state.rim_speed_mps;
    return Eigen::Vector3d{velocity[0] + faster, velocity[1],
                           velocity[2] + faster * curvature_at(at_s) +
                               velocity[0] * (curvature_at(at_s) - state.curvature_1pm)};
  };

  const PatchAxes axes_here(here, gravity_mps2_);
  const Eigen::Vector3d drift_here = drift(axes_here, velocity, pose[2]);
  const Stage first =
      run_stage(kGamma * h, velocity, state.transfer_forward_n, state.transfer_left_n,
                guess_at(kGamma * h), pose + kGamma * h * drift_here);
  if (!result.converged) return result;
  const Eigen::Vector3d pose_first = pose + kGamma * h * drift_here;
  const Eigen::Vector3d drift_first =
      drift(PatchAxes(first.patch, gravity_mps2_), first.velocity, pose_first[2]);

  const double rest = (1 - kGamma) / kGamma;  // (1 - gamma) h K1 = rest (stage value - start)
  const Eigen::Vector3d base = velocity + rest * (first.velocity - velocity);
  const double forward_base =
      state.transfer_forward_n + rest * (first.transfer_forward_n - state.transfer_forward_n);
  const double left_base =
      state.transfer_left_n + rest * (first.transfer_left_n - state.transfer_left_n);
  const Eigen::Vector3d pose_end_predicted = pose + h * drift_first;
  const Stage second = run_stage(h, base, forward_base, left_base,
                                 base + kGamma * h * first.acceleration, pose_end_predicted);
  if (!result.converged) return result;
  const Eigen::Vector3d drift_end =
      drift(PatchAxes(second.patch, gravity_mps2_), second.velocity, pose_end_predicted[2]);
  const Eigen::Vector3d pose_end = pose + h * ((1 - kGamma) * drift_first + kGamma * drift_end);

  result.state = {.x_m = pose_end[0],
                  .y_m = pose_end[1],
                  .yaw_rad = std::remainder(pose_end[2], 2 * std::numbers::pi),
                  .motion = motion_of(second.velocity),
                  .curvature_1pm = curvature_at(h),
                  .rim_speed_mps = rim_at(h),
                  .rim_acceleration_mps2 = (rim_at(h) - state.rim_speed_mps) / h,
                  .transfer_forward_n = second.transfer_forward_n,
                  .transfer_left_n = second.transfer_left_n};
  result.strain = second.strain;
  result.drive_energy_j = h * ((1 - kGamma) * first.drive_power_w + kGamma * second.drive_power_w);
  return result;
}

StepResult VehicleDynamics::step(const VehicleState& state, const VehicleControl& control,
                                 double duration_s) const {
  StepResult whole = try_step(state, control, duration_s);
  if (whole.converged || !whole.on_known_ground) return whole;
  constexpr double kShortest_s = 1e-4;
  if (duration_s / 2 < kShortest_s) {
    whole.state = state;
    return whole;
  }
  const StepResult first = step(state, control, duration_s / 2);
  if (!first.converged || !first.on_known_ground) return first;
  StepResult second = step(first.state, control, duration_s / 2);
  second.drive_energy_j += first.drive_energy_j;
  return second;
}

VehicleState VehicleDynamics::rolling_state(double x_m, double y_m, double yaw_rad,
                                            double speed_mps, double curvature_1pm) const {
  const double slip_free = kinematic_body_slip_angle_rad(vehicle_, curvature_1pm);
  return {.x_m = x_m,
          .y_m = y_m,
          .yaw_rad = std::remainder(yaw_rad, 2 * std::numbers::pi),
          .motion = {.vx_mps = speed_mps * std::cos(slip_free),
                     .vy_mps = speed_mps * std::sin(slip_free),
                     .yaw_rate_rad_s = speed_mps * curvature_1pm},
          .curvature_1pm = curvature_1pm,
          .rim_speed_mps = speed_mps};
}

}  // namespace regoplan
