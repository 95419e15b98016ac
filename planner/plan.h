#pragma once

#include "planner/problem/plan_result.h"
#include "planner/problem/planning_problem.h"
#include "planner/runtime/single_thread.h"
#include "planner/stages/plan_session.h"

namespace regoplan {

/// Searches, verifies and ranks. Searches, verifications and all else that is dear run in child
/// processes, several at once: a path is verified as soon as it is found, while the search goes
/// on.
/// \param alone proof that the process has one thread; throws where it has more
/// \throws ValueError, InputError as `validate(problem)`
PlanResult plan(const PlanningProblem& problem, const PlanSession& session = {},
                SingleThread alone = {});

}  // namespace regoplan
