#pragma once

#include <string>
#include <vector>

#include "planner/problem/planning_problem.h"

namespace regoplan {

/// Names of the map's soils that may not bear the vehicle: the mean does, driving slowly straight
/// on within every limit over slopes as half of its ground has, and more than one in twenty of its
/// draws does not. A search at the means cannot see that a path across such a soil is a gamble.
std::vector<std::string> doubtful_soils(const PlanningProblem& problem);

}  // namespace regoplan
