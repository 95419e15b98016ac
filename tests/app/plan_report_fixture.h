#pragma once

#include <limits>

#include "planner/problem/plan_result.h"
#include "planner/problem/planning_problem.h"

namespace regoplan {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Craters on three soils with a corner nobody knows, a forbidden patch and rocks; drawn by hand.
/// \param cells a side of the square map of 200 m
TerrainMap report_test_map(int cells = 400);

/// A query over that map.
PlanningProblem report_test_problem(TerrainMap map);

/// What a search might have answered: three verified paths, one overturned, states rejected for
/// every reason, two what-ifs. Made up, for reports to be drawn of; no physics.
PlanResult report_test_result(const PlanningProblem& problem);

}  // namespace regoplan
