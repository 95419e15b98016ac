#include "planner/ompl/arrival.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/ompl/path_cost.h"
#include "planner/ompl/steering_samplers.h"

namespace regoplan {
namespace {

/// Where to come to rest: a little before the goal's centre, which saves time and leaves room.
constexpr double kShortOfCentre = 0.4;  // of the goal's radius

/// A vehicle that still moves then does not come to rest.
double longest_braking_s(const World& world, const VehicleState& from) {
  constexpr double kSettling_s = 3;
  return std::abs(from.rim_speed_mps) / world.problem().vehicle.acceleration_max_mps2 +
         std::max(kSettling_s, 3 * world.search_step_s());
}

/// A way to arrive: so far at the speed that the vehicle has, then braking, on one curvature.
struct Approach {
  double hold_m = 0;
  double curvature_1pm = 0;
};

/// Where an approach came to rest, or why it did not.
struct Landing {
  VehicleState end;
  bool reached = false;
  bool at_rest = false;
  std::optional<Rejection> refused;
  double cost = 0;
};

class Approaches {
 public:
  Approaches(SearchSteps& steps, const VehicleSpace::Values& from, const ArrivalBounds& bounds)
      : steps_(steps),
        world_(steps.world()),
        problem_(world_.problem()),
        from_(from),
        bounds_(bounds),
        step_s_(world_.search_step_s()),
        speed_mps_(std::abs(from.vehicle.rim_speed_mps)),
        direction_(from.vehicle.rim_speed_mps < 0 ? -1 : 1),
        arrival_mps_(std::min(speed_mps_, World::kSearchLimitShare * problem_.goal.speed_max_mps)),
        braking_m_(braking_distance_m(problem_.vehicle, speed_mps_, arrival_mps_)) {}

  /// The slip-free approach; nothing where there is none.
  std::optional<Approach> first() const {
    const Goal& goal = problem_.goal;
    const VehicleState& state = from_.vehicle;
    const double away_m = std::hypot(goal.x_m - state.x_m, goal.y_m - state.y_m);
    // A straight way is the shortest.
    if (speed_mps_ == 0 || away_m > braking_m_ + bounds_.hold_max_m + goal.radius_m) return {};
    const double share = std::max(0.0, 1 - kShortOfCentre * goal.radius_m / std::max(away_m, 1e-9));
    const double dx = share * (goal.x_m - state.x_m), dy = share * (goal.y_m - state.y_m);
    const double c = std::cos(state.yaw_rad), s = std::sin(state.yaw_rad);
    const double ahead = direction_ * (c * dx + s * dy), aside = c * dy - s * dx;
    const double chord_m = std::hypot(dx, dy);
    Approach approach;
    double way_m = 0;
    if (chord_m > 0) {
      if (ahead <= 0) return {};
      const double half_turn = std::atan2(std::abs(aside), ahead);
      way_m = half_turn > 0 ? chord_m * half_turn / std::sin(half_turn) : chord_m;
      approach.curvature_1pm = 2 * aside / (chord_m * chord_m);
    }
    approach.hold_m = std::max(0.0, way_m - braking_m_);
    const bool overshoots = braking_m_ > way_m + goal.radius_m;
    const bool too_sharp = std::abs(approach.curvature_1pm) > most_1pm();
    const double turn = direction_ * (approach.hold_m + braking_m_) * approach.curvature_1pm;
    if (overshoots || too_sharp || approach.hold_m > bounds_.hold_max_m || !heads_right(turn)) {
      return {};
    }
    return approach;
  }

  Landing drive(const Approach& approach) {
    controls_.clear();
    const double held_step_m = speed_mps_ * step_s_;
    const auto holds = static_cast<int>(std::ceil(approach.hold_m / held_step_m - 1e-6));
    // A little slower, so that whole steps make the distance.
    const double held_mps = holds > 0 ? approach.hold_m / (holds * step_s_) : 0;
    const auto brakes = static_cast<int>(longest_braking_s(world_, from_.vehicle) / step_s_);
    Landing landing{.end = from_.vehicle};
    VehicleSpace::Values values = from_;
    for (int i = 0; i < holds + brakes; ++i) {
      const double target_mps = i < holds ? direction_ * held_mps : 0;
      advance({.speed_target_mps = target_mps, .curvature_target_1pm = approach.curvature_1pm},
              values, landing);
      if (landing.refused || landing.reached || landing.cost >= bounds_.cost_below) return landing;
      landing.at_rest = i >= holds && world_.dynamics().at_rest(values.vehicle);
      if (landing.at_rest) return landing;
    }
    return landing;
  }

  /// By where the last one ended; nothing where that makes no difference.
  std::optional<Approach> corrected(const Approach& last, const Landing& landing) const {
    const VehicleState& end = landing.end;
    const Goal& goal = problem_.goal;
    const double dx = goal.x_m - end.x_m, dy = goal.y_m - end.y_m;
    const double c = std::cos(end.yaw_rad), s = std::sin(end.yaw_rad);
    const double travel_m = last.hold_m + braking_m_;
    const double short_by_m = direction_ * (c * dx + s * dy) - kShortOfCentre * goal.radius_m;
    const double left_by_m = c * dy - s * dx;
    const Approach next{
        .hold_m = std::max(0.0, last.hold_m + short_by_m),
        .curvature_1pm = std::clamp(last.curvature_1pm + 2 * left_by_m / (travel_m * travel_m),
                                    -most_1pm(), most_1pm())};
    constexpr double kSame_m = 0.02, kSame = 0.01;
    const bool same = std::abs(next.hold_m - last.hold_m) < kSame_m &&
                      std::abs(next.curvature_1pm - last.curvature_1pm) <
                          kSame * problem_.vehicle.curvature_max_1pm;
    return same ? std::nullopt : std::optional(next);
  }

  std::vector<ControlSegment> take() { return std::move(controls_); }

 private:
  double most_1pm() const {
    return curvature_reach_1pm(world_, from_.vehicle.x_m, from_.vehicle.y_m, speed_mps_);
  }

  bool heads_right(double turn_rad) const {
    const Goal& goal = problem_.goal;
    if (!goal.heading_rad) return true;
    const double end_rad = from_.vehicle.yaw_rad + turn_rad;
    return std::abs(std::remainder(end_rad - *goal.heading_rad, 2 * std::numbers::pi)) <=
           goal.heading_tolerance_rad;
  }

  void advance(const VehicleControl& control, VehicleSpace::Values& values, Landing& landing) {
    const SearchStep step = steps_.next(values, control, step_s_);
    landing.cost += step_cost(world_, values, step, step_s_);
    values = step.values;
    landing.end = values.vehicle;
    const bool goes_on =
        !controls_.empty() && controls_.back().speed_target_mps == control.speed_target_mps;
    if (goes_on) {
      controls_.back().duration_s += step_s_;
    } else {
      controls_.push_back({.duration_s = step_s_,
                           .speed_target_mps = control.speed_target_mps,
                           .curvature_target_1pm = control.curvature_target_1pm});
    }
    landing.refused = steps_.rejected(values);
    if (landing.refused || !world_.at_goal(values.vehicle)) return;
    landing.refused = refused_stop(steps_, values);
    landing.reached = !landing.refused;
  }

  SearchSteps& steps_;
  const World& world_;
  const PlanningProblem& problem_;
  const VehicleSpace::Values& from_;
  ArrivalBounds bounds_;
  double step_s_;
  double speed_mps_;
  double direction_;
  double arrival_mps_;
  double braking_m_;
  std::vector<ControlSegment> controls_;
};

std::optional<Rejection> refused_stop(SearchSteps& steps, VehicleSpace::Values values,
                                      double curvature_1pm) {
  const World& world = steps.world();
  const double step_s = world.search_step_s();
  const VehicleControl brake{.speed_target_mps = 0, .curvature_target_1pm = curvature_1pm};
  const double longest_s = longest_braking_s(world, values.vehicle);
  for (double time_s = 0; time_s < longest_s; time_s += step_s) {
    if (world.dynamics().at_rest(values.vehicle)) return std::nullopt;
    values = steps.next(values, brake, step_s).values;
    if (const auto rejected = steps.rejected(values)) return rejected;
  }
  return Rejection::kSlip;  // it slides with its wheels locked
}

}  // namespace

double braking_distance_m(const Vehicle& vehicle, double from_mps, double to_mps) {
  return std::max(0.0, from_mps * from_mps - to_mps * to_mps) / (2 * vehicle.acceleration_max_mps2);
}

std::optional<Rejection> refused_stop(SearchSteps& steps, const VehicleSpace::Values& from) {
  const auto refused = refused_stop(steps, from, from.vehicle.curvature_1pm);
  return refused && refused_stop(steps, from, 0) ? refused : std::nullopt;
}

Arrival arrival_from(SearchSteps& steps, const VehicleSpace::Values& from,
                     const ArrivalBounds& bounds) {
  Arrival arrival;
  if (steps.world().at_goal(from.vehicle)) {
    arrival.refused = refused_stop(steps, from);
    arrival.reached = !arrival.refused;
    return arrival;
  }
  Approaches approaches(steps, from, bounds);
  std::optional<Approach> approach = approaches.first();
  constexpr int kTries = 4;
  for (int i = 0; i < kTries && approach; ++i) {
    const Landing landing = approaches.drive(*approach);
    arrival.refused = landing.refused;
    if (landing.reached) {
      arrival.reached = true;
      arrival.controls = approaches.take();
      arrival.cost = landing.cost;
      return arrival;
    }
    if (!landing.at_rest) break;  // forbidden, too dear or sliding: a shift would not mend it
    approach = approaches.corrected(*approach, landing);
  }
  return arrival;
}

}  // namespace regoplan
