// ROS2, a linearly implicit method of second order and two stages: J. G. Verwer, E. J. Spee,
// J. G. Blom, W. Hundsdorfer, "A second-order Rosenbrock method applied to photochemical dispersion
// problems", SIAM J. Sci. Comput. 20 (1999) 1456-1480:
//
//   y1 = y0 + 3/2 h k1 + 1/2 h k2
//   (I - gamma h J) k1 = f(t0, y0) + gamma h f_t
//   (I - gamma h J) k2 = f(t0 + h, y0 + h k1) - 2 k1 - gamma h f_t
//
// Of second order whatever J and f_t are, L-stable with the exact ones. Here J has the stiff parts
// exactly, velocities by velocities, load transfer and pose by velocities; what loads and headings
// do to forces is left out. f_t is that of steering and rims.
#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "terramech/vehicle/step_commands.h"
#include "terramech/vehicle/vehicle_dynamics.h"

namespace regoplan {

std::optional<StepResult> VehicleDynamics::linearly_implicit_step(const VehicleState& state,
                                                                  const VehicleControl& control,
                                                                  double duration_s) const {
  const double h = duration_s, m = vehicle_.mass_kg, inertia = vehicle_.yaw_inertia_kgm2;
  const Commands start = commands_after(state, control, 0), end = commands_after(state, control, h);
  if (start.on_the_spot || !(start.rim_speed_mps * end.rim_speed_mps > 0)) return std::nullopt;
  const GroundPatch here = ground_(state.x_m, state.y_m, state.yaw_rad);
  if (!here.known) return std::nullopt;

  const WheelSetting setting_start = setting(start);
  std::optional<WheelSetting> changed;
  if (end.differ_from(start)) changed = setting(end);
  const WheelSetting& setting_end = changed ? *changed : setting_start;
  const PatchAxes axes(here, gravity_mps2_);
  const Eigen::Vector3d pose{state.x_m, state.y_m, state.yaw_rad};
  const Eigen::Vector3d v = vector_of(state.motion);
  const Eigen::Vector3d per_force{1 / m, 1 / m, 1 / inertia};
  const Eigen::Vector2d transfer{state.transfer_forward_n, state.transfer_left_n};
  const SlopedWheelSums first =
      wheels_.sums_with_slopes(state.motion, setting_start, setting_end, here,
                               reaction(here, axes, v[0], transfer[0], transfer[1]));
  if (!first.smooth) return std::nullopt;

  const double gh = kGamma * h;
  const Eigen::Matrix3d jacobian = jacobian_of(first.slopes, per_force, v);
  const Eigen::Matrix3d solve = (Eigen::Matrix3d::Identity() - gh * jacobian).inverse();
  const Eigen::Vector3d by_setting = per_force.cwiseProduct(first.by_setting);
  const Eigen::Vector3d faster = kGamma * by_setting;
  const Eigen::Vector3d f1 = acceleration_of(first.sums.force, axes, per_force, v);
  const Eigen::Vector3d k1 = solve * (f1 + faster);

  // Load transfer, d transfer/dt = (force - transfer)/time.
  const double per_time = 1 / kTransferTime_s, lag = 1 / (1 + gh * per_time);
  const auto force_of = [](const BodyForce& force) {
    return Eigen::Vector2d{force.forward_n, force.left_n};
  };
  const Eigen::Vector2d stronger = kGamma * per_time * first.by_setting.head<2>();
  const auto by_velocity = [&](const Eigen::Vector3d& k) -> Eigen::Vector2d {
    return gh * per_time * (first.slopes * k).head<2>();
  };
  const Eigen::Vector2d transfer_k1 =
      lag * (per_time * (force_of(first.sums.force) - transfer) + by_velocity(k1) + stronger);

  const Drift drift(axes, state.yaw_rad);
  const Eigen::Vector3d pose_k1 = drift(v + gh * k1);
  const Eigen::Vector3d v2 = v + h * k1, pose2 = pose + h * pose_k1;
  const Eigen::Vector2d transfer2 = transfer + h * transfer_k1;
  const GroundPatch there = ground_(pose2[0], pose2[1], pose2[2]);
  StepResult result{.state = state, .strain = {}};
  if (!there.known) {
    result.on_known_ground = result.converged = false;
    return result;
  }
  const PatchAxes axes2(there, gravity_mps2_);
  const GroundReaction reaction2 = reaction(there, axes2, v2[0], transfer2[0], transfer2[1]);
  const WheelSums second = wheels_.sums(motion_of(v2), setting_end, there, reaction2);
  if (!second.as_commanded) return std::nullopt;
  const Eigen::Vector3d f2 = acceleration_of(second.force, axes2, per_force, v2);
  const Eigen::Vector3d k2 = solve * (f2 - 2 * k1 - faster);

  const auto is_below = [&](double share, const Eigen::Vector3d& error) {
    const double error2_mps2 =
        error[0] * error[0] + error[1] * error[1] + error[2] * error[2] * inertia / m;
    const double least_mps = share * std::abs(end.rim_speed_mps);
    return error2_mps2 <= least_mps * least_mps;
  };
  // The method of first order, y0 + h k1, differs by the first. Where a vehicle settles faster than
  // the step, both may end in a slide that never was: y0 + h k1 lies far beyond what it settles to,
  // and forces that saturate there do not bring it back as the linear ones would, by the second.
  if (!is_below(kSmoothShare, h / 2 * (k1 + k2))) return std::nullopt;
  const Eigen::Vector3d saturated = f1 + by_setting + h * jacobian * k1 - f2;
  if (!is_below(kBeyondShare, h * (solve * saturated))) return std::nullopt;

  const Eigen::Vector2d transfer_k2 = lag * (per_time * (force_of(second.force) - transfer2) -
                                             2 * transfer_k1 + by_velocity(k2) - stronger);
  const Eigen::Vector3d pose_k2 = Drift(axes2, pose2[2])(v2) - 2 * pose_k1 + gh * drift(k2);
  const Eigen::Vector3d pose_end = pose + h * (1.5 * pose_k1 + 0.5 * pose_k2);
  const Eigen::Vector2d transfer_end = transfer + h * (1.5 * transfer_k1 + 0.5 * transfer_k2);
  const BodyMotion motion_end = motion_of(v + h * (1.5 * k1 + 0.5 * k2));
  result.state =
      end.state(pose_end, motion_end, transfer_end, (end.rim_speed_mps - start.rim_speed_mps) / h);
  result.strain = wheels_.strain(second, motion_end, setting_end, reaction2);
  result.drive_energy_j = h / 2 * (first.sums.drive_power_w + second.drive_power_w);
  return result;
}

}  // namespace regoplan
