#pragma once

#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "planner/problem/plan_result.h"
#include "planner/problem/planning_problem.h"
#include "planner/runtime/single_thread.h"
#include "planner/runtime/time_budget.h"
#include "planner/verdict/verified_path.h"

namespace regoplan {

/// A problem with one thing given up, and what that is, in words.
struct Relaxation {
  std::string words;
  PlanningProblem problem;
};

/// What might be otherwise for a path: less speed, less margin to spare, a higher slope limit, a
/// larger goal, stronger soils; first a small change of each, then a large one. Each is a problem
/// that can be asked as it stands.
std::vector<std::vector<Relaxation>> relaxations_of(const PlanningProblem& problem);

/// What searches of relaxed problems came to.
struct RelaxedSearch {
  std::vector<RelaxedAnswer> answers;
  /// The fastest of their paths that pass the verification of the problem as it was asked: no limit
  /// that was given up stood in its way. Such a path is opened by nothing.
  std::optional<VerifiedPath> within_limits;
};

/// Of a problem without a path: its small relaxations side by side, and, where none of them opens
/// the way, the large ones. Each is planned for briefly and the path verified, so that what helps
/// is known to. \param asked the world of verdicts on the problem itself; null where that is known
/// to have no path \param budget whose share for the answer ends it; without a budget it does not
/// hang on the clock
RelaxedSearch relaxed_search(const PlanningProblem& problem, const World* asked,
                             const TimeBudget& budget, const std::stop_token& stop,
                             const SingleThread& alone = {});

}  // namespace regoplan
