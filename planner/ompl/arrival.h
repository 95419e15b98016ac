#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "planner/ompl/search_steps.h"
#include "planner/problem/plan_result.h"

namespace regoplan {

/// The end of a path: from a state near the goal to where the goal is reached.
struct Arrival {
  bool reached = false;
  std::vector<ControlSegment> controls;  ///< none where the state has reached it already
  double cost = 0;                       ///< of driving them
  std::optional<Rejection> refused;      ///< what the last try broke, where none reached it
};

/// How far an arrival may go on before it brakes, and what it may cost.
struct ArrivalBounds {
  double hold_max_m = 0;
  double cost_below = std::numeric_limits<double>::infinity();
};

/// Holds the speed on the arc to the goal, then brakes as hard as the vehicle brakes, so that it
/// reaches the goal: at rest in it or, where the goal allows a speed, no faster than that and able
/// to stop. When to brake and how to steer is corrected by where the last try ended. Every state is
/// driven by the exact dynamics of the search and judged by `steps`. Costs next to nothing where a
/// vehicle of this speed and heading could not arrive.
Arrival arrival_from(SearchSteps& steps, const VehicleSpace::Values& from,
                     const ArrivalBounds& bounds);

/// Why a vehicle cannot stop, every state on the way judged by `steps`: neither with the steering
/// held nor straightened.
std::optional<Rejection> refused_stop(SearchSteps& steps, const VehicleSpace::Values& from);

/// The distance in which the commanded speed falls from one to a lower one.
double braking_distance_m(const Vehicle& vehicle, double from_mps, double to_mps);

}  // namespace regoplan
