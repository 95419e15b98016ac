#pragma once

#include "planner/ompl/ompl_planners.h"

namespace regoplan {

/// The command `benchmark` as a program of one's own: takes its arguments (SUITE.yaml, --out DIR,
/// --shard, merge, ...), and in suites the planners of `own` beside regoplan's. Each run is a
/// process of its own, forked from this one, which must have one thread then (`SingleThread`).
///
///     int main(int argc, char** argv) {
///       return regoplan::benchmark_main(argc, argv, {{"Mine", [](regoplan::OmplProblem& problem) {
///         return std::make_shared<Mine>(problem.space());
///       }}});
///     }
///
/// \returns the exit status: 0 done, 1 bad input (one line on standard error says which), 130 or
/// 143 interrupted
int benchmark_main(int argc, const char* const* argv, const OwnPlanners& own);

}  // namespace regoplan
