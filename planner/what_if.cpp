#include "planner/what_if.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace regoplan {
namespace {

PlanningProblem on_weaker_soils(const PlanningProblem& problem, double factor) {
  std::vector<MapSoil> soils = problem.map.soils();
  for (MapSoil& soil : soils) soil.soil.mean = with_scaled_strength(soil.soil.mean, factor);
  PlanningProblem weaker = problem;
  weaker.map = problem.map.with_soils(std::move(soils));
  return weaker;
}

/// At twice the speeds the speed limit is not the question.
PlanningProblem without_speed_limit(const PlanningProblem& problem) {
  PlanningProblem faster = problem;
  faster.speed_max_mps = std::numeric_limits<double>::infinity();
  return faster;
}

/// Judges the margins of the same moments after a change to each.
WhatIf same_path(std::string question, const World& world, const Replay& verified,
                 const std::function<VehicleState(VehicleState)>& change) {
  WhatIf result{.question = std::move(question), .feasible = true, .margin_min = 1};
  for (std::size_t i = 0; i < verified.judged.size(); ++i) {
    const VehicleState state = change(verified.judged[i].state);
    const TrajectoryPoint point = world.describe(state, {}, verified.points[i].time_s);
    if (std::isfinite(point.margin)) result.margin_min = std::min(result.margin_min, point.margin);
    if (std::isfinite(point.cornering_margin)) {
      result.margin_min = std::min(result.margin_min, point.cornering_margin);
    }
    const auto rejection = world.rejected(state, {});
    if (!rejection || !result.feasible) continue;
    result.feasible = false;
    result.reason = rejection->reason;
    result.x_m = rejection->x_m;
    result.y_m = rejection->y_m;
    result.time_s = verified.points[i].time_s;
  }
  return result;
}

WhatIf same_controls(std::string question, const World& world, const Replay& verified,
                     const std::vector<ControlSegment>& controls) {
  const Replay driven = replay(world, controls, verification_steps(world));
  // The end is told without judging on the way: the controls are driven out.
  WhatIf result{.question = std::move(question),
                .feasible = driven.reached_goal && !driven.rejection,
                .margin_min = 1};
  for (const TrajectoryPoint& point : driven.points) {
    if (std::isfinite(point.margin)) result.margin_min = std::min(result.margin_min, point.margin);
  }
  if (driven.rejection) {
    result.reason = driven.rejection->reason;
    result.x_m = driven.rejection->x_m;
    result.y_m = driven.rejection->y_m;
    result.time_s = driven.rejection_time_s;
  }
  VehicleState state = world.start();
  double time_s = 0;
  const double step_s = world.search_step_s();
  for (const ControlSegment& segment : controls) {
    const auto count = std::lround(segment.duration_s / step_s);
    for (long i = 0; i < count && time_s < verified.duration_s; ++i, time_s += step_s) {
      const StepResult step = world.dynamics().step(
          state, {segment.speed_target_mps, segment.curvature_target_1pm}, step_s);
      if (!step.converged) break;
      state = step.state;
    }
  }
  const VehicleState& end = verified.end;
  result.end_shift_m = std::hypot(state.x_m - end.x_m, state.y_m - end.y_m);
  return result;
}

}  // namespace

Soil with_scaled_strength(Soil soil, double factor) {
  soil.cohesion_pa *= factor;
  soil.friction_angle_rad = std::atan(factor * std::tan(soil.friction_angle_rad));
  return soil;
}

std::vector<WhatIf> what_ifs(const World& world, const Replay& verified,
                             const std::vector<ControlSegment>& controls) {
  const PlanningProblem weaker_problem = on_weaker_soils(world.problem(), 0.5);
  const World weaker(weaker_problem, WorldUse::kVerdict, 1);
  const PlanningProblem faster_problem = without_speed_limit(world.problem());
  const World faster(faster_problem, WorldUse::kVerdict, 1);
  const auto twice_as_fast = [](VehicleState state) {
    state.motion.vx_mps *= 2;
    state.motion.vy_mps *= 2;
    state.motion.yaw_rate_rad_s *= 2;
    state.rim_speed_mps *= 2;
    return state;
  };
  const auto as_it_is = [](VehicleState state) { return state; };
  return {same_path("the same path at twice its speeds", faster, verified, twice_as_fast),
          same_path("the same path and speeds on soils with cohesion and tan(phi) halved", weaker,
                    verified, as_it_is),
          same_controls("the same controls on soils with cohesion and tan(phi) halved", weaker,
                        verified, controls)};
}

}  // namespace regoplan
