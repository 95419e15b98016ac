#pragma once

#include <string>

#include "planner/problem/plan_result.h"

namespace regoplan {

/// What a plan's search came to, as far as it explains that there is no answer.
struct SearchEnd {
  int found = 0;
  int unverified = 0;        ///< of them neither passed nor overturned when the time was over
  bool cut_short = false;    ///< no search came to its end before the time did
  bool interrupted = false;  ///< before the time was over, which then says nothing of it
};

/// Why a problem stays undecided: first the want of time, with a time that may do; else what failed
/// verification, or what stopped the search nearest to the goal, by the way that is left.
std::string why_undecided(const PlanningProblem& problem, const PlanResult& result,
                          const SearchEnd& end);

}  // namespace regoplan
