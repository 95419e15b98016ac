#include "planner/driving/what_if.h"

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

/// Whether a vehicle's wheels turn and it hardly moves: on ground that does not carry it on, every
/// further step is dear and changes nothing.
bool stands(const VehicleState& state) {
  constexpr double kShare = 0.05;  // of the rims' speed: slip .95, beyond which no wheel is trusted
  return std::hypot(state.motion.vx_mps, state.motion.vy_mps) <
         kShare * std::abs(state.rim_speed_mps);
}

/// Where controls lead, limits aside: to their end, or to where the vehicle stands.
VehicleState driven_out(const World& world, const std::vector<ControlSegment>& controls,
                        double longest_s) {
  VehicleState state = world.start();
  double time_s = 0, standing_s = 0;
  const double step_s = world.search_step_s();
  constexpr double kForGood_s = 1;  // longer than setting off takes
  for (const ControlSegment& segment : controls) {
    const auto count = std::lround(segment.duration_s / step_s);
    for (long i = 0; i < count && time_s < longest_s; ++i, time_s += step_s) {
      const StepResult step = world.dynamics().step(
          state, {segment.speed_target_mps, segment.curvature_target_1pm}, step_s);
      state = step.state;
      standing_s = stands(state) ? standing_s + step_s : 0;
      if (!step.converged || standing_s > kForGood_s) return state;
    }
  }
  return state;
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
  const VehicleState state = driven_out(world, controls, verified.duration_s);
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

WhatIf what_if(Circumstance circumstance, const World& world, const Replay& verified,
               const std::vector<ControlSegment>& controls) {
  if (circumstance == Circumstance::kTwiceTheSpeed) {
    const PlanningProblem problem = without_speed_limit(world.problem());
    return same_path("the same path at twice its speeds", World(problem, WorldUse::kVerdict, 1),
                     verified, [](VehicleState state) {
                       state.motion.vx_mps *= 2;
                       state.motion.vy_mps *= 2;
                       state.motion.yaw_rate_rad_s *= 2;
                       state.rim_speed_mps *= 2;
                       return state;
                     });
  }
  const PlanningProblem problem = on_weaker_soils(world.problem(), 0.5);
  const World weaker(problem, WorldUse::kVerdict, 1);
  if (circumstance == Circumstance::kWeakerSoil) {
    return same_path("the same path and speeds on soils with cohesion and tan(phi) halved", weaker,
                     verified, [](const VehicleState& state) { return state; });
  }
  return same_controls("the same controls on soils with cohesion and tan(phi) halved", weaker,
                       verified, controls);
}

}  // namespace regoplan
