#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/driving/replay.h"
#include "planner/problem/plan_result.h"
#include "planner/runtime/plain_bytes.h"

namespace regoplan {

/// A path as a search found it.
struct FoundPath {
  std::string planner;
  std::uint64_t seed = 0;
  std::vector<ControlSegment> controls;
  bool off_doubtful_soils = false;  ///< where the map's doubtful soils are forbidden
};

/// A candidate with the replay that judged it; `candidate.verified` says whether it passed.
struct VerifiedPath {
  Candidate candidate;
  Replay replay;
};

/// Drives a path again with the direct wheel model and a ten times finer step, and judges it: the
/// goal is reached, every limit holds at every step, every margin wherever it is solved. A path
/// that does not pass is steered back to where the search had it and judged once more: errors of
/// the search's tables and steps grow with the way, and its controls alone would end metres aside
/// of a long one.
/// \param verdict, searched the two worlds of one problem, the latter without doubtful soils
/// where the path was found off them
VerifiedPath verify(const World& verdict, const World& searched, const FoundPath& path);

/// A path that passed, driven again in the world of another problem of the same vehicle and map.
/// \param steps those that it was verified with
VerifiedPath verified_in(const World& verdict, const ReplaySteps& steps, const VerifiedPath& path);

/// A path that passed, improved (`improved`); nothing where that gains nothing, does not pass
/// verification in its turn or has a smaller margin.
std::optional<VerifiedPath> improved_path(const World& verdict, const World& searched,
                                          const VerifiedPath& path);

/// Hands every field to an archive, so that a path can be told to another process (`bytes_of`).
template <class Archive, FieldsOf<VerifiedPath> Path>
void each_field(Archive& archive, Path& path) {
  auto& candidate = path.candidate;
  archive(candidate.rank);
  archive(candidate.planner);
  archive(candidate.seed);
  archive(candidate.off_doubtful_soils);
  archive(candidate.controls);
  archive(candidate.improvement);
  archive(candidate.points);
  archive(candidate.length_m);
  archive(candidate.duration_s);
  archive(candidate.energy_j);
  archive(candidate.margin_min);
  archive(candidate.margin_worst_tenth);
  archive(candidate.spread);
  archive(candidate.limiting);
  archive(candidate.verified.passed);
  archive(candidate.verified.reason);
  archive(candidate.verified.margin_min);
  archive(candidate.verified.deviation_max_m);
  auto& replay = path.replay;
  archive(replay.points);
  archive(replay.judged);
  archive(replay.coarse);
  archive(replay.end);
  archive(replay.rejection);
  archive(replay.rejection_time_s);
  archive(replay.reached_goal);
  archive(replay.energy_j);
  archive(replay.length_m);
  archive(replay.duration_s);
}

}  // namespace regoplan
