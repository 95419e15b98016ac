#pragma once

#include "planner/ompl/search_steps.h"
#include "planner/problem/planning_problem.h"

namespace regoplan {

/// What a step of a search costs, by the objective of the problem; additive along the path.
double step_cost(const World& world, const VehicleSpace::Values& from, const SearchStep& step,
                 double duration_s);

/// Roughly what driving so far in so long costs: rolling on loose soil takes a tenth of the weight.
double rough_cost(const PlanningProblem& problem, double length_m, double duration_s);

/// No path of this length costs less: at top speed, no energy, margins to spare.
double least_cost(const PlanningProblem& problem, double length_m);

}  // namespace regoplan
