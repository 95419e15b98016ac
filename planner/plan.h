#pragma once

#include <functional>
#include <stop_token>

#include "planner/plan_result.h"
#include "planner/planning_problem.h"

namespace regoplan {

/// What a search is doing, for whoever watches.
struct PlanProgress {
  std::string_view stage;  ///< "searching", "verifying", "improving", "drawing soils"
  double share = 0;        ///< of this stage, 0 to 1
  int found = 0;           ///< paths found so far
};

/// Searches, verifies and ranks. A request to stop ends it early with what there is, marked
/// interrupted. Must be called while the process has one thread: planners run in child processes.
/// \throws ValueError, InputError as `validate(problem)`
PlanResult plan(const PlanningProblem& problem,
                const std::function<void(const PlanProgress&)>& on_progress,
                const std::stop_token& stop);

}  // namespace regoplan
