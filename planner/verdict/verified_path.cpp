#include "planner/verdict/verified_path.h"

#include <fmt/format.h>

#include "planner/driving/path_margins.h"
#include "planner/driving/steer_back.h"
#include "planner/ompl/path_improvement.h"
#include "planner/problem/rejection_text.h"

namespace regoplan {
namespace {

std::string why_overturned(const Replay& replay) {
  if (const auto& rejection = replay.rejection) {
    return fmt::format("{}, {:.2f} s", rejection_text(*rejection), replay.rejection_time_s);
  }
  const VehicleState& end = replay.end;
  return fmt::format("the goal is not reached: the path ends at ({:.2f}, {:.2f})", end.x_m,
                     end.y_m);
}

bool passes(const Replay& replayed) {
  return replayed.reached_goal && !replayed.rejection;
}

/// Fills in what the replay tells.
void describe(Candidate& candidate, const Replay& replayed) {
  candidate.points = replayed.points;
  candidate.length_m = replayed.length_m;
  candidate.duration_s = replayed.duration_s;
  candidate.energy_j = replayed.energy_j;
  candidate.verified.passed = passes(replayed);
  if (!candidate.verified.passed) candidate.verified.reason = why_overturned(replayed);
  if (candidate.points.empty()) return;
  candidate.margin_min = candidate.points[smallest_margin_index(candidate.points)].margin;
  candidate.verified.margin_min = candidate.margin_min;
  candidate.margin_worst_tenth = margin_of_worst_tenth(candidate.points);
  candidate.limiting = limiting_place(candidate.points);
}

}  // namespace

VerifiedPath verify(const World& verdict, const World& searched, const FoundPath& path) {
  const ReplaySteps fine = verification_steps(verdict);
  const Replay as_searched = replay(searched, path.controls, {.coarse_s = fine.coarse_s}, false);
  VerifiedPath verified{.candidate = {.planner = path.planner,
                                      .seed = path.seed,
                                      .off_doubtful_soils = path.off_doubtful_soils,
                                      .controls = path.controls},
                        .replay = replay(verdict, path.controls, fine)};
  if (!passes(verified.replay)) {
    verified.candidate.controls = steered_back(verdict, fine, path.controls, as_searched.coarse);
    verified.replay = replay(verdict, verified.candidate.controls, fine);
  }
  describe(verified.candidate, verified.replay);
  verified.candidate.verified.deviation_max_m = deviation_max_m(verified.replay, as_searched);
  return verified;
}

VerifiedPath verified_in(const World& verdict, const ReplaySteps& steps, const VerifiedPath& path) {
  VerifiedPath again{.candidate = path.candidate,
                     .replay = replay(verdict, path.candidate.controls, steps)};
  describe(again.candidate, again.replay);
  again.candidate.verified.deviation_max_m += deviation_max_m(again.replay, path.replay);
  return again;
}

std::optional<VerifiedPath> improved_path(const World& verdict, const World& searched,
                                          const VerifiedPath& path) {
  const Candidate& before = path.candidate;
  const std::optional<ImprovedPath> found = improved(searched, before.controls);
  if (!found) return std::nullopt;
  VerifiedPath after = verify(verdict, searched,
                              {.planner = before.planner,
                               .seed = before.seed,
                               .controls = found->controls,
                               .off_doubtful_soils = before.off_doubtful_soils});
  if (!after.candidate.verified.passed || after.candidate.margin_min < before.margin_min) {
    return std::nullopt;
  }
  after.candidate.improvement = found->improvement;
  return after;
}

}  // namespace regoplan
