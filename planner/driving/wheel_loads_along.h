#pragma once

#include <span>
#include <vector>

#include "planner/problem/plan_result.h"
#include "planner/problem/planning_problem.h"

namespace regoplan {

/// Load of each wheel, newtons, in the vehicle's order, at each point of a path: that of the steady
/// manoeuvre which is commanded there, its lateral demand kept within the supply. NaN where the
/// ground is unknown. Points that turn on the spot count as straight ahead.
std::vector<std::vector<double>> wheel_loads_along_n(const PlanningProblem& problem,
                                                     std::span<const TrajectoryPoint> points);

}  // namespace regoplan
