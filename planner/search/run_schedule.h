#pragma once

#include <optional>

#include "planner/ompl/search_run.h"
#include "planner/problem/planning_problem.h"

namespace regoplan {

/// Hands out the runs of a plan's search: planner, seed and guidance by the run's number. Under an
/// iteration budget there are a set number of them, under a time budget as many as it takes to find
/// enough paths. Where soils are doubtful every other run, from the second on, keeps off
/// them.
class RunSchedule {
 public:
  /// \param search must outlive it \param margin_min that every path keeps
  RunSchedule(const Search& search, double margin_min, bool has_doubtful_soils = false)
      : search_(search), margin_min_(margin_min), has_doubtful_soils_(has_doubtful_soils) {}

  /// The next run, nothing where no more are wanted.
  /// \param found so far \param left_s for searching, under a time budget
  std::optional<SearchRun> next(int found, double left_s);

  /// Paths that are enough: more than candidates, so that there is a choice.
  int wanted() const { return kRunsPerCandidate * search_.candidates; }
  int given() const { return number_; }

 private:
  static constexpr int kRunsPerCandidate = 3;

  const Search& search_;
  double margin_min_;
  bool has_doubtful_soils_;
  int number_ = 0;
};

}  // namespace regoplan
