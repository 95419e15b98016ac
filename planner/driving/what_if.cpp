#include "planner/driving/what_if.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "planner/driving/margin_draws.h"
#include "planner/driving/path_margins.h"
#include "planner/problem/changed_problem.h"
#include "planner/problem/margin_spread.h"

namespace regoplan {
namespace {

using MapPoint = std::array<double, 2>;  ///< x_m, y_m

PlanningProblem on_weaker_soils(const PlanningProblem& problem, double factor) {
  std::vector<MapSoil> soils = problem.map.soils();
  for (MapSoil& soil : soils) soil.soil.mean = with_scaled_strength(soil.soil.mean, factor);
  return with_soils(problem, std::move(soils));
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
std::vector<MapPoint> driven_out(const World& world, const std::vector<ControlSegment>& controls,
                                 double longest_s) {
  VehicleState state = world.start();
  std::vector<MapPoint> way{{state.x_m, state.y_m}};
  double time_s = 0, standing_s = 0;
  const double step_s = world.search_step_s();
  constexpr double kForGood_s = 1;  // longer than setting off takes
  for (const ControlSegment& segment : controls) {
    const auto count = std::lround(segment.duration_s / step_s);
    for (long i = 0; i < count && time_s < longest_s; ++i, time_s += step_s) {
      const StepResult step = world.dynamics().step(
          state, {segment.speed_target_mps, segment.curvature_target_1pm}, step_s);
      state = step.state;
      way.push_back({state.x_m, state.y_m});
      standing_s = stands(state) ? standing_s + step_s : 0;
      if (!step.converged || standing_s > kForGood_s) return way;
    }
  }
  return way;
}

/// Every so manieth place, and the last.
std::vector<MapPoint> thinned(const std::vector<MapPoint>& way) {
  constexpr std::size_t kMost = 300;
  const std::size_t every = way.size() / kMost + 1;
  std::vector<MapPoint> kept;
  for (std::size_t i = 0; i + 1 < way.size(); i += every) kept.push_back(way[i]);
  kept.push_back(way.back());
  return kept;
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
  const std::vector<MapPoint> way = driven_out(world, controls, verified.duration_s);
  result.end_shift_m =
      std::hypot(way.back()[0] - verified.end.x_m, way.back()[1] - verified.end.y_m);
  result.driven = thinned(way);
  return result;
}

VehicleState slowed(VehicleState state, double share) {
  state.motion.vx_mps *= share;
  state.motion.vy_mps *= share;
  state.motion.yaw_rate_rad_s *= share;
  state.rim_speed_mps *= share;
  state.rim_acceleration_mps2 *= share * share;
  return state;
}

/// The same path at a share of its speeds, judged where it was.
Replay slowed(const World& world, const Replay& verified, double share) {
  Replay slower;
  for (std::size_t i = 0; i < verified.judged.size(); ++i) {
    const auto& [state, strain] = verified.judged[i];
    slower.judged.push_back({slowed(state, share), strain});
    slower.points.push_back(
        world.describe(slower.judged.back().state, strain, verified.points[i].time_s / share));
  }
  return slower;
}

}  // namespace

WhatIf slow_enough(const World& world, const Replay& verified, int draws, double asked) {
  const PlanningProblem& problem = world.problem();
  WhatIf result{.feasible = true};
  for (int tenths = 9; tenths >= 5; --tenths) {
    const double share = tenths / 10.0;
    const Replay slower = slowed(world, verified, share);
    const MarginSpread spread =
        margin_spread(smallest_margins(problem, slower, {.count = draws}, problem.search.seed, 1),
                      problem.limits.margin_min);
    result.question = fmt::format("the same path at {} of its speeds", share);
    result.probability = spread.feasible;
    result.margin_min = slower.points[smallest_margin_index(slower.points)].margin;
    if (spread.feasible.share >= asked) break;
  }
  return result;
}

Soil with_scaled_strength(Soil soil, double factor) {
  soil.cohesion_pa *= factor;
  soil.friction_angle_rad = std::atan(factor * std::tan(soil.friction_angle_rad));
  return soil;
}

WhatIf what_if(Circumstance circumstance, const World& world, const Replay& verified,
               const std::vector<ControlSegment>& controls) {
  if (circumstance == Circumstance::kTwiceTheSpeed) {
    // At twice the speeds the speed limit is not the question.
    const PlanningProblem problem =
        with_speed_max(world.problem(), std::numeric_limits<double>::infinity());
    return same_path(
        "the same path at twice its speeds, gathering speed and braking as hard as it does",
        World(problem, WorldUse::kVerdict, 1), verified, [](VehicleState state) {
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
