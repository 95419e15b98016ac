// The two-stage singly diagonally implicit Runge-Kutta method of second order of R. Alexander,
// "Diagonally implicit Runge-Kutta methods for stiff O.D.E.'s", SIAM J. Numer. Anal. 14 (1977)
// 1006-1021: y1 = y0 + (1 - gamma) h K1 + gamma h K2, both stages implicit in gamma h, the second
// at the end of the step.
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "terramech/vehicle/step_commands.h"
#include "terramech/vehicle/vehicle_dynamics.h"

namespace regoplan {

/// One implicit stage: velocities v with v = base + step dv/dt(v), everything else given.
struct VehicleDynamics::Stage {
  GroundPatch patch;
  WheelSetting setting;
  bool on_the_spot = false;
  Eigen::Vector3d base;
  double step_s = 0;
  std::optional<Eigen::Matrix3d> newton;  ///< inverse, of a stage nearby
  double transfer_forward_base_n = 0, transfer_left_base_n = 0;

  // the solution
  Eigen::Vector3d velocity;
  Eigen::Vector3d acceleration;
  double transfer_forward_n = 0, transfer_left_n = 0;
  WheelSums sums;

  /// The load transfers go after the forces. \return by how much they change, N
  double follow(const BodyForce& force, double lag);
};

double VehicleDynamics::Stage::follow(const BodyForce& force, double lag) {
  const double forward_n =
      transfer_forward_base_n + lag * (force.forward_n - transfer_forward_base_n);
  const double left_n = transfer_left_base_n + lag * (force.left_n - transfer_left_base_n);
  const double change_n =
      std::max(std::abs(forward_n - transfer_forward_n), std::abs(left_n - transfer_left_n));
  transfer_forward_n = forward_n;
  transfer_left_n = left_n;
  return change_n;
}

/// Where a vehicle settles faster than a step, the second stage sets out from far beyond what it
/// settles to, and forces must bring it back. Where they saturate, as those of a sliding wheel do,
/// they do not within the step, and it would end in a slide that never was.
bool VehicleDynamics::overshoots(const Eigen::Vector3d& start, const Stage& first,
                                 const Stage& second) const {
  const double arm_m = std::sqrt(vehicle_.yaw_inertia_kgm2 / vehicle_.mass_kg);
  const Eigen::Vector3d in_mps{1, 1, arm_m};
  const Eigen::Vector3d began = start.cwiseProduct(in_mps);
  const Eigen::Vector3d settled = first.velocity.cwiseProduct(in_mps);
  const Eigen::Vector3d extrapolated = second.base.cwiseProduct(in_mps);
  const Eigen::Vector3d ended = second.velocity.cwiseProduct(in_mps);
  const bool pushed_back = (settled - began).dot(ended - extrapolated) < 0;
  const double speed_mps =
      std::max({began.norm(), std::abs(second.setting.rim_speed), kStandstillSpeed_mps});
  return pushed_back && (ended - settled).norm() > kBeyondShare * speed_mps;
}

bool VehicleDynamics::solve_stage(Stage& stage) const {
  const PatchAxes axes(stage.patch, gravity_mps2_);
  const double m = vehicle_.mass_kg, inertia = vehicle_.yaw_inertia_kgm2;
  const Eigen::Vector3d per_force{1 / m, 1 / m, 1 / inertia};
  const double h = stage.step_s;
  const double lag = h / (h + kTransferTime_s);
  const Eigen::Vector3d in_mps{1, 1, std::sqrt(inertia / m)};
  // All but at rest, and in a turn on the spot, the balance may lie on a jump of the forces: where
  // a wheel that turns stops moving, it spins on the one side and counter-rotates on the other.
  const auto is_on_a_jump = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    constexpr double kNearRest_mps = kStandstillSpeed_mps, kJump_mps = 1e-2 * kNearRest_mps;
    return (stage.on_the_spot || from.cwiseProduct(in_mps).norm() < kNearRest_mps) &&
           (to - from).cwiseProduct(in_mps).norm() < kJump_mps;
  };
  double error_before = 0, missing_before = 0;
  bool slows = false;
  Eigen::Vector3d velocity_before = stage.velocity;
  int halvings = 0;
  for (int iteration = 0; iteration < 40; ++iteration) {
    // The slopes are dear: taken anew only where the old ones slow the convergence down.
    const bool with_slopes = !stage.newton || slows;
    const Eigen::Vector3d& v = stage.velocity;
    const GroundReaction loads =
        reaction(stage.patch, axes, v[0], stage.transfer_forward_n, stage.transfer_left_n);
    const SlopedWheelSums sloped =
        with_slopes ? wheels_.sums_with_slopes(motion_of(v), stage.setting, stage.setting,
                                               stage.patch, loads)
                    : SlopedWheelSums{
                          .sums = wheels_.sums(motion_of(v), stage.setting, stage.patch, loads)};
    const WheelSums& sums = sloped.sums;
    const BodyForce& f = sums.force;
    stage.acceleration = acceleration_of(f, axes, per_force, v);
    const double transfer_error = stage.follow(f, lag) / (m * axes.gravity_normal_mps2);
    stage.sums = sums;

    const Eigen::Vector3d missing = stage.base + h * stage.acceleration - v;
    const double missing_mps = missing.cwiseProduct(in_mps).norm();
    if (iteration > 0 && missing_mps > missing_before && halvings < 10) {
      // Sliding friction saturates: a whole step may only change the direction of the slide.
      ++halvings;
      slows = true;
      stage.velocity = (stage.velocity + velocity_before) / 2;
      if (is_on_a_jump(velocity_before, stage.velocity)) return true;
      continue;
    }
    halvings = 0;
    missing_before = missing_mps;
    velocity_before = v;
    if (with_slopes) {
      stage.newton =
          (Eigen::Matrix3d::Identity() - h * jacobian_of(sloped.slopes, per_force, v)).inverse();
    }
    const Eigen::Vector3d change = *stage.newton * missing;
    if (!change.allFinite()) return false;
    const double scale =
        std::max({std::abs(v[0]), std::abs(stage.setting.rim_speed), kStandstillSpeed_mps});
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

VehicleDynamics::TriedStep VehicleDynamics::implicit_step(const VehicleState& state,
                                                          const VehicleControl& control,
                                                          double duration_s) const {
  const double h = duration_s;
  TriedStep tried{.result = {.state = state, .strain = {}}};
  StepResult& result = tried.result;
  const Eigen::Vector3d pose{state.x_m, state.y_m, state.yaw_rad};
  const Eigen::Vector3d velocity = vector_of(state.motion);
  const GroundPatch here = ground_(pose[0], pose[1], pose[2]);
  if (!here.known) {
    result.on_known_ground = false;
    return tried;
  }

  std::optional<Eigen::Matrix3d> newton;
  // Velocities are solved implicitly; poses, which are not stiff, follow with the ground taken at a
  // prediction of second order.
  const auto run_stage = [&](double at_s, const Eigen::Vector3d& base, double forward_base_n,
                             double left_base_n, const Eigen::Vector3d& guess,
                             const Eigen::Vector3d& pose_there) {
    const Commands commands = commands_after(state, control, at_s);
    Stage stage{.patch = ground_(pose_there[0], pose_there[1], pose_there[2]),
                .setting = setting(commands),
                .on_the_spot = commands.on_the_spot,
                .base = base,
                .step_s = kGamma * h,
                .newton = newton,
                .transfer_forward_base_n = forward_base_n,
                .transfer_left_base_n = left_base_n,
                .velocity = guess,
                .acceleration = Eigen::Vector3d::Zero(),
                .transfer_forward_n = forward_base_n,
                .transfer_left_n = left_base_n,
                .sums = {}};
    result.on_known_ground = stage.patch.known;
    result.converged = stage.patch.known && solve_stage(stage);
    newton = stage.newton;
    return stage;
  };
  // Guess that slip and side slip stay as they are while the rims speed up.
  const auto guess_at = [&](double at_s) {
    const Commands then = commands_after(state, control, at_s);
    const double faster = then.rim_speed_mps - state.rim_speed_mps;
    const double k = then.steering.curvature_1pm;
    return Eigen::Vector3d{velocity[0] + faster, velocity[1],
                           velocity[2] + faster * k + velocity[0] * (k - state.curvature_1pm) +
                               (then.turn_rate_rad_s - state.turn_rate_rad_s)};
  };

  const PatchAxes axes_here(here, gravity_mps2_);
  const Eigen::Vector3d drift_here = Drift(axes_here, pose[2])(velocity);
  const Stage first =
      run_stage(kGamma * h, velocity, state.transfer_forward_n, state.transfer_left_n,
                guess_at(kGamma * h), pose + kGamma * h * drift_here);
  if (!result.converged) return tried;
  const Eigen::Vector3d pose_first = pose + kGamma * h * drift_here;
  const Eigen::Vector3d drift_first =
      Drift(PatchAxes(first.patch, gravity_mps2_), pose_first[2])(first.velocity);

  const double rest = (1 - kGamma) / kGamma;  // (1 - gamma) h K1 = rest (stage value - start)
  const Eigen::Vector3d base = velocity + rest * (first.velocity - velocity);
  const double forward_base =
      state.transfer_forward_n + rest * (first.transfer_forward_n - state.transfer_forward_n);
  const double left_base =
      state.transfer_left_n + rest * (first.transfer_left_n - state.transfer_left_n);
  const Eigen::Vector3d pose_end_predicted = pose + h * drift_first;
  Stage second = run_stage(h, base, forward_base, left_base, base + kGamma * h * first.acceleration,
                           pose_end_predicted);
  if (!result.converged) return tried;
  const BodyMotion motion_end = motion_of(second.velocity);
  const GroundReaction reaction_end =
      reaction(second.patch, PatchAxes(second.patch, gravity_mps2_), second.velocity[0],
               second.transfer_forward_n, second.transfer_left_n);
  if (!second.sums.strain_known) {
    second.sums = wheels_.sums(motion_end, second.setting, second.patch, reaction_end);
  }
  const Eigen::Vector3d drift_end =
      Drift(PatchAxes(second.patch, gravity_mps2_), pose_end_predicted[2])(second.velocity);
  const Eigen::Vector3d pose_end = pose + h * ((1 - kGamma) * drift_first + kGamma * drift_end);

  const Commands end = commands_after(state, control, h);
  result.state =
      end.state(pose_end, motion_end, {second.transfer_forward_n, second.transfer_left_n},
                (end.rim_speed_mps - state.rim_speed_mps) / h);
  result.strain = wheels_.strain(second.sums, motion_end, second.setting, reaction_end);
  result.drive_energy_j =
      h * ((1 - kGamma) * first.sums.drive_power_w + kGamma * second.sums.drive_power_w);
  tried.overshoots = overshoots(velocity, first, second);
  return tried;
}

}  // namespace regoplan
