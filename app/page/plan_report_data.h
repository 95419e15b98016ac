#pragma once

#include <nlohmann/json.hpp>

#include "planner/problem/plan_result.h"
#include "planner/problem/planning_problem.h"

namespace regoplan {

/// Everything the planning report draws. Names end in their unit, angles are in degrees, numbers
/// that are not finite become null when it is written. Of a long path about 1000 points stand: the
/// first, the last and from each stretch the one with the smallest margin.
nlohmann::json plan_report_data(const PlanningProblem& problem, const PlanResult& result);

}  // namespace regoplan
