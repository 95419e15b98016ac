#pragma once

#include <string>
#include <vector>

#include "planner/problem/planning_problem.h"

namespace regoplan {

// The same question with one thing changed. Maps share their rasters: a changed question costs
// little.

PlanningProblem with_soils(PlanningProblem problem, std::vector<MapSoil> soils);
/// Ground of these soils, named, is forbidden.
PlanningProblem with_soils_forbidden(PlanningProblem problem,
                                     const std::vector<std::string>& soils);
PlanningProblem with_speed_max(PlanningProblem problem, double speed_max_mps);
PlanningProblem with_goal_radius(PlanningProblem problem, double radius_m);
PlanningProblem with_limits(PlanningProblem problem, const Limits& limits);

}  // namespace regoplan
