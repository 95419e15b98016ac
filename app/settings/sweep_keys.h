#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "planner/problem/planning_problem.h"
#include "terramech/basics/value_range.h"

namespace regoplan {

/// A number of a problem that a suite may vary, in the unit at the end of its key.
struct SweepKey {
  ValueRange allowed;
  /// Sets it. \throws InputError where the problem does not have it (a soil of another map)
  std::function<void(PlanningProblem&, double)> set;
};

/// The number that a key names:
///
///     speed_mps.max, start.speed_mps, goal.speed_mps.max, goal.radius_m, gravity_mps2
///     limits.KEY          # as in a scenario
///     vehicle.KEY         # numbers of a vehicle's file that are no limits, wheel.radius_m too
///     soils.NAME.KEY      # the mean of one soil; its standard deviation stays
///     soil.KEY            # of every soil
///
/// \throws InputError saying what may stand there
SweepKey sweep_key(std::string_view key);

}  // namespace regoplan
