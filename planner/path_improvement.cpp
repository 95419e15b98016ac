#include "planner/path_improvement.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

constexpr double kTopShare = 0.94;  // downhill the vehicle is faster than its rims
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
Driven drive(const World& world, double margin_min, double cost_below, ControlAt control_at) {
  const double step_s = world.search_step_s();
  SearchSteps steps(world, margin_min, 0);
  VehicleSpace::Values values{.vehicle = world.start(), .strain = {}};
  Driven path{.states = {values.vehicle}, .controls = {}};
  for (std::size_t i = 0; path.cost < cost_below; ++i) {
    const std::optional<VehicleControl> control = control_at(i, values.vehicle);
    if (!control) return path;
    const SearchStep step = steps.next(values, *control, step_s);
    path.cost += step_cost(world, values, step, step_s);
    values = step.values;
    if (!steps.allowed(values)) {
      const auto& counts = steps.rejections().counts();
      const auto first = std::find_if(counts.begin(), counts.end(), [](auto n) { return n > 0; });
      path.rejected = static_cast<Rejection>(first - counts.begin());
      return path;
    }
    path.states.push_back(values.vehicle);
    path.controls.push_back({.duration_s = step_s,
                             .speed_target_mps = control->speed_target_mps,
                             .curvature_target_1pm = control->curvature_target_1pm});
    path.reached_goal = world.at_goal(values.vehicle);
    if (path.reached_goal) return path;
  }
  return path;
}

/// As given, nothing judged but by the world's bare limits.
Driven as_given(const World& world, const std::vector<ControlSegment>& controls) {
  std::vector<VehicleControl> by_step;
  for (const ControlSegment& segment : controls) {
    const long steps = std::lround(segment.duration_s / world.search_step_s());
    by_step.insert(by_step.end(), static_cast<std::size_t>(std::max(0L, steps)),
                   {.speed_target_mps = segment.speed_target_mps,
                    .curvature_target_1pm = segment.curvature_target_1pm});
  }
  return drive(world, 0, std::numeric_limits<double>::infinity(),
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

/// Along a curve in closed loop.
Driven along(const World& world, const PathCurve& curve, const SpeedProfile& speed,
             double margin_min, double cost_below) {
  const PlanningProblem& problem = world.problem();
  const double step_s = world.search_step_s();
  double s = 0, rim_mps = problem.start.speed_mps;
  const double a = problem.vehicle.acceleration_max_mps2;
  Driven path =
      drive(world, margin_min, cost_below,
            [&](std::size_t, const VehicleState& now) -> std::optional<VehicleControl> {
              if (s >= curve.length_m()) return std::nullopt;
              const CurvePlace place = curve.at(s);
              // Steering takes time: what is commanded is the curvature a little farther on.
              constexpr double kReaction_s = 0.3;
              const VehicleState due{
                  .x_m = place.x_m,
                  .y_m = place.y_m,
                  .yaw_rad = place.heading_rad +
                             -kinematic_body_slip_angle_rad(problem.vehicle, now.curvature_1pm),
                  .rim_speed_mps = std::max(rim_mps, 1e-3)};
              const double target = speed.at(s + rim_mps * step_s).speed_mps;
              const VehicleControl control = steered_back(
                  problem,
                  {.speed_target_mps = target,
                   .curvature_target_1pm = curve.at(s + kReaction_s * rim_mps).curvature_1pm},
                  due, now);
              const double before = rim_mps;
              rim_mps += std::clamp(target - rim_mps, -a * step_s, a * step_s);
              s += (before + rim_mps) / 2 * step_s;
              return control;
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
Driven fastest_along(const World& world, const PathCurve& curve, double margin_min,
                     double cost_below) {
  constexpr int kTries = 16;
  constexpr double kSlower = 0.93, kBefore_m = 8, kAfter_m = 4;
  const PlanningProblem& problem = world.problem();
  std::vector<SpeedProfile::Node> most = allowed_by_curvature(problem, curve);
  Driven path;
  for (int i = 0; i < kTries; ++i) {
    path = along(world, curve, fastest(problem, most), margin_min, cost_below);
    if (!path.rejected || !slower_may_help(*path.rejected)) return path;
    for (SpeedProfile::Node& node : most) {
      if (node.s_m < path.end_m - kBefore_m || node.s_m > path.end_m + kAfter_m) continue;
      node.speed_mps =
          std::max(kSlower * node.speed_mps, kSlowestShare * kTopShare * problem.speed_max_mps);
    }
  }
  return path;
}

}  // namespace

std::optional<ImprovedPath> improved(const World& searched,
                                     const std::vector<ControlSegment>& controls) {
  const PlanningProblem& problem = searched.problem();
  const Driven before = as_given(searched, controls);
  const bool reverses =
      std::any_of(before.states.begin(), before.states.end(),
                  [](const VehicleState& state) { return state.rim_speed_mps < 0; });
  const double spacing_m = 1 / problem.vehicle.curvature_max_1pm;
  const std::vector<PathPoint> knots = knots_of(before.states, spacing_m);
  if (!before.reached_goal || reverses || knots.size() < 4) return std::nullopt;
  const double margin_min =
      std::max(problem.limits.margin_min, smallest_margin(searched, before.states));

  const double at_speed = curvature_reach_1pm(problem, kTopShare * problem.speed_max_mps);
  const std::vector<PathPoint> proposed = smoothed(problem, knots, 0.8 * at_speed);
  Driven best = before;
  for (const double share : {1.0, 0.6, 0.3, 0.0}) {
    std::vector<PathPoint> points;
    for (std::size_t i = 0; i < knots.size(); ++i) {
      points.push_back({std::lerp(knots[i].x_m, proposed[i].x_m, share),
                        std::lerp(knots[i].y_m, proposed[i].y_m, share)});
    }
    points.push_back(beyond(problem, points));
    const Driven tried = fastest_along(searched, PathCurve(points), margin_min, best.cost);
    if (tried.reached_goal && tried.cost < best.cost) best = tried;
  }
  if (!(best.cost < before.cost)) return std::nullopt;
  return ImprovedPath{.controls = best.controls,
                      .improvement = {.cost_before = before.cost, .cost_after = best.cost}};
}

}  // namespace regoplan
