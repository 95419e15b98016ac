#pragma once

#include <vector>

#include "planner/certificate/undecided.h"
#include "planner/stages/plan_underway.h"
#include "planner/verdict/verified_path.h"

namespace regoplan {

/// What searching and verifying came to.
struct SearchResult {
  std::vector<VerifiedPath> paths;  ///< that passed, by run
  SearchEnd end;
  double ended_s = 0;  ///< the last search, since the plan's start
};

/// Runs searches and verifies what they find side by side, the most promising path first.
/// \param result takes what was overturned, the counts of rejected states and of propagations
SearchResult search_and_verify(const PlanUnderway& plan, PlanResult& result);

}  // namespace regoplan
