#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

#include "planner/problem/world.h"
#include "planner/runtime/time_budget.h"
#include "planner/stages/announcements.h"

namespace regoplan {

// When each stage ends, as shares of the time of the whole answer. A search that has found nothing
// that passes, or where soils are doubtful nothing that keeps off them, goes on longer; a stage
// that is done early gives the rest to those that follow.
inline constexpr double kSearchShare = 0.4, kFirstPathShare = 0.75;
inline constexpr double kVerifyShare = 0.5, kFirstVerifyShare = 0.85;
inline constexpr double kImproveShare = 0.75;
inline constexpr double kDrawsShare = 0.92;

/// What every stage of a plan works with.
struct PlanUnderway {
  const PlanningProblem& problem;
  const World& verdict;
  const World& searched;
  const World*
      searched_off_doubt;  ///< where doubtful soils are forbidden; null where none is doubtful
  const TimeBudget& budget;
  const std::stop_token& stop;
  Announcements& announcements;

  /// The world of a search, or of what was found by it.
  const World& searched_world(bool off_doubtful_soils) const {
    return off_doubtful_soils ? *searched_off_doubt : searched;
  }
};

/// A piece of a stage's work, for a process of its own.
struct Piece {
  std::function<std::vector<char>()> work;
  double time_limit_s = 0;                                            ///< infinite: none
  std::function<void(const std::optional<std::vector<char>>&)> take;  ///< nothing: it failed
  std::function<bool()> superfluous{};                                ///< as of a ChildTask
};

/// Works off pieces in child processes, until none is underway and `next` gives none.
void work_off(const PlanUnderway& plan, const std::function<std::optional<Piece>()>& next);

}  // namespace regoplan
