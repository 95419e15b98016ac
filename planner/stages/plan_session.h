#pragma once

#include <chrono>
#include <functional>
#include <stop_token>
#include <string_view>

#include "planner/problem/plan_result.h"

namespace regoplan {

/// What a plan is doing, for whoever watches.
struct PlanProgress {
  std::string_view stage;  ///< "searching", "improving", "drawing soils", ...
  double share = 0;        ///< of this stage, 0 to 1
  int found = 0;           ///< paths found so far
  int verified = 0;        ///< of them verified
};

/// What surrounds a plan: who watches, what ends it, since when its time counts.
struct PlanSession {
  std::function<void(const PlanProgress&)> on_progress = [](const PlanProgress&) {};
  /// Told of each path as soon as it has passed its verification; ranks come later.
  std::function<void(const Candidate&, double since_start_s)> on_verified = [](const Candidate&,
                                                                               double) {};
  /// Told when status, reason and ranks stand; what is worked out after that explains them.
  std::function<void(const PlanResult&)> on_answer = [](const PlanResult&) {};
  /// A request ends the plan within moments, with what there is, marked interrupted.
  std::stop_token stop{};
  /// `Search::time_s` is the time of the whole answer from here on.
  std::chrono::steady_clock::time_point started = std::chrono::steady_clock::now();
};

}  // namespace regoplan
