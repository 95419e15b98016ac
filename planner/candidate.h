#pragma once

#include <functional>
#include <string>
#include <vector>

#include "planner/plan.h"
#include "planner/replay.h"

namespace regoplan {

/// A path as a search found it.
struct FoundPath {
  std::string planner;
  std::uint64_t seed = 0;
  std::vector<ControlSegment> controls;
};

/// A candidate with the replay that judged it.
struct VerifiedPath {
  Candidate candidate;
  Replay replay;
};

struct VerifiedPaths {
  std::vector<VerifiedPath> passed;
  std::vector<Candidate> overturned;
};

/// Drives every path again with the direct wheel model and a ten times finer step, and judges it:
/// the goal is reached, every limit holds at every step, every margin wherever it is solved. A path
/// that does not pass is steered back to where the search had it and judged once more: errors of
/// the search's tables and steps grow with the way, and its controls alone would end metres aside
/// of a long one.
/// \param verdict, searched the two worlds of one problem
VerifiedPaths verify_all(const World& verdict, const World& searched,
                         const std::vector<FoundPath>& found,
                         const std::function<void(const PlanProgress&)>& on_progress);

/// The paths with the largest margins that really differ: each strays from every other by at least
/// 2 m and 4 % of the way somewhere.
std::vector<VerifiedPath> different_paths(std::vector<VerifiedPath> paths, int most);

/// Of paths that passed, the improved ones (`improved`): those that pass verification in their
/// turn, with no smaller margin.
std::vector<VerifiedPath> improved_paths(const World& verdict, const World& searched,
                                         const std::vector<VerifiedPath>& paths);

/// Fills in what depends on the soils' uncertainty.
void add_spread(const PlanningProblem& problem, VerifiedPath& path);

/// By the 5 % quantile of the smallest margin in steps of 0.01, then the mean margin over the worst
/// tenth of the length, time and energy. Numbers the ranks from 1.
void rank(std::vector<VerifiedPath>& paths);

}  // namespace regoplan
