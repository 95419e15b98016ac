#include "planner/stages/improvement_stage.h"

#include <iterator>
#include <utility>

#include "planner/runtime/plain_bytes.h"
#include "planner/verdict/ranking.h"

namespace regoplan {

std::vector<VerifiedPath> improved_choice(const PlanUnderway& plan,
                                          std::vector<VerifiedPath> paths) {
  const auto different = [&problem = plan.problem](std::vector<VerifiedPath> of) {
    return different_paths(std::move(of), problem.vehicle, problem.search.candidates);
  };
  std::vector<VerifiedPath> chosen = different(paths);
  if (!plan.problem.search.improve) return chosen;
  std::vector<std::optional<VerifiedPath>> better(chosen.size());
  std::size_t next = 0;
  work_off(plan, [&]() -> std::optional<Piece> {
    const double left_s = plan.budget.left_s(kImproveShare);
    if (next == chosen.size() || left_s <= 0) return std::nullopt;
    plan.announcements.stage("improving",
                             static_cast<double>(next) / static_cast<double>(chosen.size()));
    const std::size_t i = next++;
    return Piece{.work =
                     [&plan, &chosen, i] {
                       const auto path = improved_path(
                           plan.verdict,
                           plan.searched_world(chosen[i].candidate.off_doubtful_soils), chosen[i]);
                       return path ? bytes_of(*path) : std::vector<char>();
                     },
                 .time_limit_s = left_s,
                 .take =
                     [&plan, &better, i](const std::optional<std::vector<char>>& bytes) {
                       if (!bytes || bytes->empty()) return;
                       better[i] = from_bytes<VerifiedPath>(*bytes);
                       if (better[i]) plan.announcements.path_verified(better[i]->candidate);
                     }};
  });
  // The improved stand first among equals; the others fill in where they differ.
  std::vector<VerifiedPath> all;
  for (std::optional<VerifiedPath>& path : better) {
    if (path) all.push_back(std::move(*path));
  }
  std::move(paths.begin(), paths.end(), std::back_inserter(all));
  return different(std::move(all));
}

}  // namespace regoplan
