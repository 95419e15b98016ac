#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "benchmarking/run_journal.h"
#include "benchmarking/suite.h"
#include "planner/problem/planning_problem.h"
#include "planner/runtime/single_thread.h"

namespace regoplan {

/// How far a suite has come.
struct SuiteProgress {
  std::string experiment;
  std::size_t done = 0;
  std::size_t total = 0;
  std::optional<double> remaining_s;  ///< estimated from the runs of this session
};

/// What surrounds the runs of a suite.
struct SuiteSession {
  int processes = 1;          ///< at once
  OwnPlanners planners = {};  ///< one's own, beside those of regoplan
  std::function<void(const SuiteProgress&)> on_progress = [](const SuiteProgress&) {};
  std::stop_token stop{};
};

/// Makes each planner of a suite once, before the first run, in a process of its own.
/// \param problem of the suite, any: parameters mean the same in each
/// \throws InputError for a planner's parameter that is not known or not valid, with the planner's
/// place in the suite's file
void require_parameters(const Suite& suite, const PlanningProblem& problem,
                        const SuiteSession& session, const SingleThread& alone = {});

/// Does those of the runs that the journal does not hold, each in a process of its own: a planner
/// that crashes, leaks or hangs costs one run.
/// \param problem_of the problem of a scenario at a sweep point, by their places in the suite
/// \throws InputError for a planner's parameter that is not valid, with its place in the suite's
/// file, or a journal that cannot be written
void run_suite(const Suite& suite, const std::vector<SuiteRun>& runs, RunJournal& journal,
               const std::function<PlanningProblem(std::size_t, std::size_t)>& problem_of,
               const SuiteSession& session, const SingleThread& alone = {});

}  // namespace regoplan
