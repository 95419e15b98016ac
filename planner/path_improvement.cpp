#include "planner/path_improvement.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/drive.h"
#include "planner/path_cost.h"
#include "planner/path_curve.h"
#include "planner/path_smoothing.h"
#include "planner/search_steps.h"
#include "planner/speed_profile.h"
#include "planner/steer_back.h"
#include "planner/steering_samplers.h"
#include "terramech/input_error.h"

namespace regoplan {
namespace {

// Where the vehicle comes out faster than its rims, downhill, it is made slower.
constexpr double kTopShare = 0.97;
constexpr double kSlowestShare = 0.05;

/// A path as the search drives it, from the start.
struct Driven {
  std::vector<VehicleState> states;
  std::vector<ControlSegment> controls;
  double cost = 0;
  bool reached_goal = false;
  std::optional<Rejection> rejected = {};  ///< why it ends
  double end_m = 0;                        ///< along the curve that it follows
};

/// Drives step by step, as long as every state is allowed and below a cost.
/// \param control of (step, state), nothing at the end
template <class ControlAt>
Driven drive(SearchSteps& steps, double cost_below, ControlAt control_at) {
  const World& world = steps.world();
  const double step_s = world.search_step_s();
  VehicleSpace::Values values{.vehicle = world.start(), .strain = {}};
  Driven path{.states = {values.vehicle}, .controls = {}};
  for (std::size_t i = 0; path.cost < cost_below; ++i) {
    const std::optional<VehicleControl> control = control_at(i, values.vehicle);
    if (!control) return path;
    const SearchStep step = steps.next(values, *control, step_s);
    path.cost += step_cost(world, values, step, step_s);
    values = step.values;
    path.rejected = steps.rejected(values);
    if (path.rejected) return path;
    path.states.push_back(values.vehicle);
    path.controls.push_back({.duration_s = step_s,
                             .speed_target_mps = control->speed_target_mps,
                             .curvature_target_1pm = control->curvature_target_1pm});
    path.reached_goal = world.at_goal(values.vehicle);
    if (path.reached_goal) return path;
  }
  return path;
}

Driven as_given(SearchSteps& steps, const std::vector<ControlSegment>& controls) {
  std::vector<VehicleControl> by_step;
  for (const Drive& drive : drives_of(controls, steps.world().search_step_s())) {
    by_step.insert(by_step.end(), static_cast<std::size_t>(drive.steps), drive.control);
  }
  return drive(steps, std::numeric_limits<double>::infinity(),
               [&](std::size_t i, const VehicleState&) -> std::optional<VehicleControl> {
                 if (i >= by_step.size()) return std::nullopt;
                 return by_step[i];
               });
}

double smallest_margin(const World& world, const std::vector<VehicleState>& states) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const VehicleState& state : states) {
    const GroundPatch patch = world.dynamics().ground(state.x_m, state.y_m, state.yaw_rad);
    smallest = std::min(smallest, world.margins(state, patch).stability().value_or(-1));
  }
  return smallest;
}

std::vector<PathPoint> knots_of(const std::vector<VehicleState>& states, double spacing_m) {
  std::vector<PathPoint> knots{{states.front().x_m, states.front().y_m}};
  double since_m = 0;
  for (std::size_t i = 1; i < states.size(); ++i) {
    since_m += std::hypot(states[i].x_m - states[i - 1].x_m, states[i].y_m - states[i - 1].y_m);
    const bool last = i + 1 == states.size();
    if (since_m < spacing_m && !last) continue;
    if (last && since_m < spacing_m / 2 && knots.size() > 1) knots.pop_back();
    knots.push_back({states[i].x_m, states[i].y_m});
    since_m = 0;
  }
  return knots;
}

/// A way on beyond the last knot, so that a vehicle that is a little aside still crosses the goal.
PathPoint beyond(const PlanningProblem& problem, const std::vector<PathPoint>& knots) {
  const PathPoint &a = knots[knots.size() - 2], &b = knots.back();
  const double length = std::hypot(b.x_m - a.x_m, b.y_m - a.y_m);
  const double on_m = std::max(problem.goal.radius_m, 1.0);
  return {b.x_m + on_m * (b.x_m - a.x_m) / length, b.y_m + on_m * (b.y_m - a.y_m) / length};
}

/// What curvature allows along a curve, about every metre.
std::vector<SpeedProfile::Node> allowed_by_curvature(const PlanningProblem& problem,
                                                     const PathCurve& curve) {
  constexpr double kEvery_m = 1;
  const double top = kTopShare * problem.speed_max_mps;
  std::vector<SpeedProfile::Node> most;
  const int count = std::max(1, static_cast<int>(curve.length_m() / kEvery_m));
  for (int i = 0; i <= count; ++i) {
    const double s = curve.length_m() * i / count;
    const double curvature = std::max(1e-6, std::abs(curve.at(s).curvature_1pm));
    // The reach falls with the square of the speed.
    const double holding = top * std::sqrt(curvature_reach_1pm(problem, top) / curvature);
    most.push_back({s, std::clamp(holding, kSlowestShare * top, top)});
  }
  return most;
}

SpeedProfile fastest(const PlanningProblem& problem, const std::vector<SpeedProfile::Node>& most) {
  const double top = kTopShare * problem.speed_max_mps;
  return limited_by_acceleration(most, std::max(kSlowestShare * top, problem.start.speed_mps), top,
                                 problem.vehicle.acceleration_max_mps2);
}

/// Along a curve in closed loop. What is due is where the vehicle is along the curve, not where the
/// time says it should be: in soft soil it falls behind, and would not have arrived by the end.
Driven along(SearchSteps& steps, const PathCurve& curve, const SpeedProfile& speed,
             double cost_below) {
  const PlanningProblem& problem = steps.world().problem();
  double s = 0;
  Driven path =
      drive(steps, cost_below,
            [&](std::size_t, const VehicleState& now) -> std::optional<VehicleControl> {
              const CurvePlace before = curve.at(s);
              s += std::cos(before.heading_rad) * (now.x_m - before.x_m) +
                   std::sin(before.heading_rad) * (now.y_m - before.y_m);
              if (s >= curve.length_m()) return std::nullopt;
              const CurvePlace place = curve.at(s);
              const VehicleState due{
                  .x_m = place.x_m,
                  .y_m = place.y_m,
                  .yaw_rad = place.heading_rad -
                             kinematic_body_slip_angle_rad(problem.vehicle, now.curvature_1pm),
                  .rim_speed_mps = std::max(now.rim_speed_mps, 1e-3)};
              // Steering takes time: what is commanded is what is due a little farther on.
              constexpr double kReaction_s = 0.3;
              const double ahead_m = s + kReaction_s * due.rim_speed_mps;
              return steered_back(
                  problem,
                  {.speed_target_mps =
                       speed.at(s + steps.world().search_step_s() * due.rim_speed_mps).speed_mps,
                   .curvature_target_1pm = curve.at(ahead_m).curvature_1pm},
                  due, now);
            });
  path.end_m = s;
  return path;
}

/// Too fast downhill is out of bounds.
bool slower_may_help(Rejection rejection) {
  return rejection == Rejection::kBounds || rejection == Rejection::kSlip ||
         rejection == Rejection::kSlipAngle || rejection == Rejection::kTraction ||
         rejection == Rejection::kTipOver || rejection == Rejection::kCornering;
}

/// Along a curve as fast as the margin allows: slower where it was missed, until it is kept or
/// there is nothing to gain. What it ends with may not have reached the goal.
Driven fastest_along(SearchSteps& steps, const PathCurve& curve, double cost_below) {
  constexpr int kTries = 40;
  constexpr double kSlower = 0.96, kBefore_m = 8, kAfter_m = 4;
  const PlanningProblem& problem = steps.world().problem();
  std::vector<SpeedProfile::Node> most = allowed_by_curvature(problem, curve);
  Driven path;
  for (int i = 0; i < kTries; ++i) {
    path = along(steps, curve, fastest(problem, most), cost_below);
    if (!path.rejected || !slower_may_help(*path.rejected)) return path;
    for (SpeedProfile::Node& node : most) {
      if (node.s_m < path.end_m - kBefore_m || node.s_m > path.end_m + kAfter_m) continue;
      node.speed_mps =
          std::max(kSlower * node.speed_mps, kSlowestShare * kTopShare * problem.speed_max_mps);
    }
  }
  return path;
}

/// What comes of a path by smoothing it; the path itself where nothing better does.
Driven cheaper_beside(SearchSteps& steps, const Driven& path) {
  const PlanningProblem& problem = steps.world().problem();
  const std::vector<PathPoint> knots = knots_of(path.states, 1 / problem.vehicle.curvature_max_1pm);
  if (knots.size() < 4) return path;
  const double at_speed = curvature_reach_1pm(problem, kTopShare * problem.speed_max_mps);
  const std::vector<PathPoint> proposed = smoothed(problem, knots, 0.8 * at_speed);
  Driven best = path;
  for (const double share : {1.0, 0.6, 0.3, 0.0}) {
    std::vector<PathPoint> points;
    for (std::size_t i = 0; i < knots.size(); ++i) {
      points.push_back({std::lerp(knots[i].x_m, proposed[i].x_m, share),
                        std::lerp(knots[i].y_m, proposed[i].y_m, share)});
    }
    points.push_back(beyond(problem, points));
    Driven tried = fastest_along(steps, PathCurve(points), best.cost);
    if (tried.reached_goal && tried.cost < best.cost) best = std::move(tried);
  }
  return best;
}

}  // namespace

std::optional<ImprovedPath> improved(SearchSteps& steps,
                                     const std::vector<ControlSegment>& controls) {
  const Driven before = as_given(steps, controls);
  const bool reverses =
      std::any_of(before.states.begin(), before.states.end(),
                  [](const VehicleState& state) { return state.rim_speed_mps < 0; });
  if (!before.reached_goal || reverses) return std::nullopt;
  constexpr int kRounds = 4;
  constexpr double kWorthIt = 0.003;  // of the cost, for another round
  Driven best = before;
  for (int round = 0; round < kRounds; ++round) {
    Driven next = cheaper_beside(steps, best);
    if (!(next.cost < best.cost)) break;
    const bool go_on = next.cost < (1 - kWorthIt) * best.cost;
    best = std::move(next);
    if (!go_on) break;
  }
  if (!(best.cost < before.cost)) return std::nullopt;
  return ImprovedPath{.controls = best.controls,
                      .improvement = {.cost_before = before.cost, .cost_after = best.cost}};
}

std::optional<ImprovedPath> improved(const World& searched,
                                     const std::vector<ControlSegment>& controls) {
  SearchSteps judged_by_bare_limits(searched, 0, 0);
  const Driven before = as_given(judged_by_bare_limits, controls);
  const double margin_min =
      std::max(searched.problem().limits.margin_min, smallest_margin(searched, before.states));
  SearchSteps steps(searched, margin_min, 0);
  return improved(steps, controls);
}

}  // namespace regoplan
