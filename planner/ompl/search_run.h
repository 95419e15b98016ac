#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "planner/problem/plan_result.h"
#include "planner/problem/world.h"
#include "planner/runtime/plain_bytes.h"

namespace regoplan {

/// What a run keeps to, and is led by.
struct SearchGuidance {
  std::uint64_t seed = 1;
  double margin_min = 0;  ///< every state keeps at least this stability margin
  double variety = 0;     ///< of the way that it is guided along, as `CostToGo` takes it
  bool improve = false;   ///< go on for a better path until the bound, where the planner can
};

/// One run of one planner. Exactly one of `time_s` and `iterations` bounds it.
struct SearchRun {
  std::string planner;  ///< one of `planner_names()`, not `auto`
  SearchGuidance guidance;
  std::optional<double> time_s;
  std::optional<std::int64_t> iterations;
  /// Where doubtful soils are forbidden; who makes the run hands it that world.
  bool off_doubtful_soils = false;
};

/// What a run came to.
struct SearchOutcome {
  std::vector<ControlSegment> controls;  ///< to the goal; empty where none was found
  std::array<std::int64_t, kRejectionCount> rejected{};
  std::vector<RejectedState> rejected_states;  ///< an even sample
  std::int64_t propagations = 0;
  double time_s = 0;  ///< wall clock, the field that guides it included
};

/// Hands every field to an archive (`bytes_of`).
template <class Archive, FieldsOf<SearchOutcome> Outcome>
void each_field(Archive& archive, Outcome& outcome) {
  archive(outcome.controls);
  archive(outcome.rejected);
  archive(outcome.rejected_states);
  archive(outcome.propagations);
  archive(outcome.time_s);
}

/// Runs a planner of OMPL in this process, OMPL's log muted meanwhile (`MutedOmpl`). Planners of
/// OMPL's own draw from random numbers that the process shares: one at a time.
SearchOutcome search(const World& world, const SearchRun& run);

}  // namespace regoplan
