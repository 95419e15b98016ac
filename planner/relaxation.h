#pragma once

#include <optional>
#include <stop_token>
#include <string>

#include "planner/planning_problem.h"

namespace regoplan {

/// Of a problem without a path: the first single thing to give up that opens the way, in words -
/// half the speed, no margin to spare, a slope limit 5 deg steeper. Each is planned for briefly and
/// the path verified, so that what is named is known to help; nothing where none does in that time.
/// Does not hang on the clock. Call it while the process has one thread.
std::optional<std::string> relaxation_that_helps(const PlanningProblem& problem,
                                                 const std::stop_token& stop);

}  // namespace regoplan
