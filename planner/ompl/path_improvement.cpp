#include "planner/ompl/path_improvement.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/course/path_curve.h"
#include "planner/course/path_smoothing.h"
#include "planner/course/speed_profile.h"
#include "planner/driving/steer_back.h"
#include "planner/ompl/arrival.h"
#include "planner/ompl/drive.h"
#include "planner/ompl/path_cost.h"
#include "planner/ompl/search_steps.h"
#include "planner/ompl/steering_samplers.h"
#include "terramech/basics/input_error.h"

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

/// A path while it is driven, step by step.
class PathDrive {
 public:
  explicit PathDrive(SearchSteps& steps)
      : steps_(steps),
        step_s_(steps.world().search_step_s()),
        values_{.vehicle = steps.world().start(), .strain = {}},
        path_{.states = {values_.vehicle}, .controls = {}} {}

  const VehicleSpace::Values& values() const { return values_; }
  const Driven& path() const { return path_; }
  Driven take() { return std::move(path_); }

  /// \returns whether the path goes on
  bool advance(const VehicleControl& control) {
    const SearchStep step = steps_.next(values_, control, step_s_);
    path_.cost += step_cost(steps_.world(), values_, step, step_s_);
    values_ = step.values;
    path_.rejected = steps_.rejected(values_);
    if (path_.rejected) return false;
    path_.states.push_back(values_.vehicle);
    path_.controls.push_back({.duration_s = step_s_,
                              .speed_target_mps = control.speed_target_mps,
                              .curvature_target_1pm = control.curvature_target_1pm});
    if (!steps_.world().at_goal(values_.vehicle)) return true;
    path_.rejected = refused_stop(steps_, values_);
    path_.reached_goal = !path_.rejected;
    return false;
  }

  /// \returns whether the path goes on
  bool advance(const std::vector<ControlSegment>& controls) {
    for (const Drive& drive : drives_of(controls, step_s_)) {
      for (int i = 0; i < drive.steps; ++i) {
        if (!advance(drive.control)) return false;
      }
    }
    return true;
  }

 private:
  SearchSteps& steps_;
  double step_s_;
  VehicleSpace::Values values_;
  Driven path_;
};

Driven as_given(SearchSteps& steps, const std::vector<ControlSegment>& controls) {
  PathDrive drive(steps);
  drive.advance(controls);
  return drive.take();
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
std::vector<SpeedProfile::Node> allowed_by_curvature(const World& world, const PathCurve& curve) {
  constexpr double kEvery_m = 1;
  const double top = kTopShare * world.problem().speed_max_mps;
  std::vector<SpeedProfile::Node> most;
  const int count = std::max(1, static_cast<int>(curve.length_m() / kEvery_m));
  for (int i = 0; i <= count; ++i) {
    const double s = curve.length_m() * i / count;
    const auto at = curve.at(s);
    const double curvature = std::max(1e-6, std::abs(at.curvature_1pm));
    // The reach falls with the square of the speed.
    const double holding =
        top * std::sqrt(curvature_reach_1pm(world, at.x_m, at.y_m, top) / curvature);
    most.push_back({s, std::clamp(holding, kSlowestShare * top, top)});
  }
  return most;
}

SpeedProfile fastest(const PlanningProblem& problem, const std::vector<SpeedProfile::Node>& most) {
  const double top = kTopShare * problem.speed_max_mps;
  return limited_by_acceleration(most, std::max(kSlowestShare * top, problem.start.speed_mps), top,
                                 problem.vehicle.acceleration_max_mps2);
}

/// The control that keeps to a curve at a speed. \param s_m how far along the vehicle is
VehicleControl control_along(const World& world, const PathCurve& curve, const SpeedProfile& speed,
                             double s_m, const VehicleState& now) {
  const PlanningProblem& problem = world.problem();
  const CurvePlace place = curve.at(s_m);
  const VehicleState due{.x_m = place.x_m,
                         .y_m = place.y_m,
                         .yaw_rad = place.heading_rad - kinematic_body_slip_angle_rad(
                                                            problem.vehicle, now.curvature_1pm),
                         .rim_speed_mps = std::max(now.rim_speed_mps, 1e-3)};
  // Steering takes time: what is commanded is what is due a little farther on.
  constexpr double kReaction_s = 0.3;
  const double ahead_m = s_m + kReaction_s * due.rim_speed_mps;
  return steered_back(
      problem,
      {.speed_target_mps = speed.at(s_m + world.search_step_s() * due.rim_speed_mps).speed_mps,
       .curvature_target_1pm = curve.at(ahead_m).curvature_1pm},
      due, now);
}

/// Along a curve in closed loop, until braking leads to the goal. What is due is where the vehicle
/// is along the curve, not where the time says it should be: in soft soil it falls behind, and
/// would not have arrived by the end.
Driven along(SearchSteps& steps, const PathCurve& curve, const SpeedProfile& speed,
             double cost_below) {
  const World& world = steps.world();
  PathDrive drive(steps);
  std::optional<Rejection> refused_arrival;
  double s = 0, refused_m = 0;
  while (drive.path().cost < cost_below) {
    const VehicleState& now = drive.values().vehicle;
    const CurvePlace before = curve.at(s);
    s += std::cos(before.heading_rad) * (now.x_m - before.x_m) +
         std::sin(before.heading_rad) * (now.y_m - before.y_m);
    if (s >= curve.length_m()) break;
    // As late as possible: no farther ahead than two steps.
    const Arrival arrival =
        arrival_from(steps, drive.values(),
                     {.hold_max_m = 2 * world.search_step_s() * std::abs(now.rim_speed_mps),
                      .cost_below = cost_below - drive.path().cost});
    if (arrival.reached) drive.advance(arrival.controls);
    if (arrival.reached) break;
    if (arrival.refused) {
      refused_arrival = arrival.refused;
      refused_m = s;
    }
    if (!drive.advance(control_along(world, curve, speed, s, now))) break;
  }
  Driven path = drive.take();
  path.end_m = s;
  if (!path.reached_goal && refused_arrival && path.cost < cost_below) {
    path.rejected = refused_arrival;
    path.end_m = refused_m;
  }
  return path;
}

bool slower_may_help(Rejection rejection) {
  return rejection == Rejection::kSpeed || rejection == Rejection::kSlip ||
         rejection == Rejection::kSlipAngle || rejection == Rejection::kTraction ||
         rejection == Rejection::kTipOver || rejection == Rejection::kCornering;
}

/// Along a curve as fast as the margin allows: slower where it was missed, until it is kept or
/// there is nothing to gain. What it ends with may not have reached the goal.
Driven fastest_along(SearchSteps& steps, const PathCurve& curve, double cost_below) {
  constexpr int kTries = 40;
  constexpr double kSlower = 0.96, kBefore_m = 8, kAfter_m = 4;
  const PlanningProblem& problem = steps.world().problem();
  std::vector<SpeedProfile::Node> most = allowed_by_curvature(steps.world(), curve);
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
  double at_speed_1pm = problem.vehicle.curvature_max_1pm;
  for (const PathPoint& knot : knots) {
    at_speed_1pm = std::min(at_speed_1pm, curvature_reach_1pm(steps.world(), knot.x_m, knot.y_m,
                                                              kTopShare * problem.speed_max_mps));
  }
  const std::vector<PathPoint> proposed = smoothed(problem, knots, 0.8 * at_speed_1pm);
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
