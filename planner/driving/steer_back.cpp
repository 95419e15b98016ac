#include "planner/driving/steer_back.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace regoplan {
namespace {

/// Joins what is commanded alike.
void append(std::vector<ControlSegment>& segments, const VehicleControl& control,
            double duration_s) {
  if (!segments.empty() && segments.back().speed_target_mps == control.speed_target_mps &&
      segments.back().curvature_target_1pm == control.curvature_target_1pm) {
    segments.back().duration_s += duration_s;
    return;
  }
  segments.push_back({.duration_s = duration_s,
                      .speed_target_mps = control.speed_target_mps,
                      .curvature_target_1pm = control.curvature_target_1pm});
}

}  // namespace

VehicleControl steered_back(const PlanningProblem& problem, const VehicleControl& commanded,
                            const VehicleState& due, const VehicleState& actual) {
  constexpr double kNear_m = 0.02, kNear_rad = 0.01, kCatchUp_s = 1, kLengthsOfArm = 2;
  const double direction = (due.rim_speed_mps > 0) - (due.rim_speed_mps < 0);
  const double c = std::cos(due.yaw_rad), s = std::sin(due.yaw_rad);
  const double dx = actual.x_m - due.x_m, dy = actual.y_m - due.y_m;
  const double ahead = c * dx + s * dy, left = c * dy - s * dx;
  const double turned = std::remainder(actual.yaw_rad - due.yaw_rad, 2 * std::numbers::pi);
  if (direction == 0 || (std::hypot(dx, dy) < kNear_m && std::abs(turned) < kNear_rad)) {
    return commanded;
  }
  const Vehicle& vehicle = problem.vehicle;
  const double length = kLengthsOfArm * longest_arm_m(vehicle);
  const double curvature =
      commanded.curvature_target_1pm - left / (length * length) - 2 * direction * turned / length;
  const double speed = commanded.speed_target_mps - ahead / kCatchUp_s;
  VehicleControl control = commanded;
  control.curvature_target_1pm =
      std::clamp(curvature, -vehicle.curvature_max_1pm, vehicle.curvature_max_1pm);
  // Never across standstill: that would change where the path turns round.
  if (commanded.speed_target_mps * direction > 0) {
    // To catch up it keeps as far below the limit as searches do: a replay may be a little faster.
    constexpr double kCatchUpShare = 0.95;
    const double most =
        std::max(std::abs(commanded.speed_target_mps), kCatchUpShare * problem.speed_max_mps);
    control.speed_target_mps = direction * std::clamp(direction * speed, 0.0, most);
  }
  return control;
}

std::vector<ControlSegment> steered_back(const World& world, const ReplaySteps& steps,
                                         const std::vector<ControlSegment>& controls,
                                         const std::vector<VehicleState>& searched) {
  const double fine_s = steps.coarse_s / steps.fine_per_coarse;
  std::vector<ControlSegment> driven;
  VehicleState state = world.start();
  std::size_t coarse = 0;
  for (const ControlSegment& segment : controls) {
    const long count = std::lround(segment.duration_s / steps.coarse_s);
    for (long i = 0; i < count && coarse < searched.size(); ++i, ++coarse) {
      const VehicleControl control =
          steered_back(world.problem(),
                       {.speed_target_mps = segment.speed_target_mps,
                        .curvature_target_1pm = segment.curvature_target_1pm},
                       searched[coarse], state);
      append(driven, control, steps.coarse_s);
      for (int k = 0; k < steps.fine_per_coarse; ++k) {
        const StepResult step = world.dynamics().step(state, control, fine_s);
        state = step.state;
        if (!step.converged || world.at_goal(state)) return driven;
      }
    }
  }
  return driven;
}

}  // namespace regoplan
