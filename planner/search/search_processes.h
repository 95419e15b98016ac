#pragma once

#include <functional>
#include <stop_token>
#include <vector>

#include "planner/ompl/search_run.h"
#include "planner/runtime/single_thread.h"

namespace regoplan {

/// Runs planners in child processes, several at once: a crash or a leak of one costs one run, and
/// each has OMPL's random numbers for itself.
/// \param next gives the next run, nothing when no more are wanted
/// \param on_outcome gets each outcome, in the order in which runs were given; nothing where a run
/// crashed or was stopped
/// Ends early, killing what runs, when stop is requested.
void search_in_processes(
    const World& world, int processes, const std::function<std::optional<SearchRun>()>& next,
    const std::function<void(const SearchRun&, const std::optional<SearchOutcome>&)>& on_outcome,
    const std::stop_token& stop, const SingleThread& alone = {});

}  // namespace regoplan
