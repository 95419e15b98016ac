#include "planner/verdict/ranking.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "planner/soils/standing.h"

namespace regoplan {
namespace {

/// The farthest that a path strays from another.
double stray_m(const Candidate& path, const Candidate& other) {
  double farthest = 0;
  for (const TrajectoryPoint& point : path.points) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const TrajectoryPoint& there : other.points) {
      nearest = std::min(nearest, std::hypot(point.x_m - there.x_m, point.y_m - there.y_m));
    }
    farthest = std::max(farthest, nearest);
  }
  return farthest;
}

bool differ(const Candidate& path, const Candidate& other, const Vehicle& vehicle) {
  constexpr double kMost_m = 2, kShareOfWay = 0.04;
  const double least_m = std::min(kMost_m, vehicle.body.y_max_m - vehicle.body.y_min_m);
  const double apart = std::max(stray_m(path, other), stray_m(other, path));
  return apart >= std::max(least_m, kShareOfWay * other.length_m);
}

/// Puts the one with the largest margin first, then the fastest, then the rest by margin.
void widest_and_fastest_first(std::vector<VerifiedPath>& paths) {
  std::stable_sort(paths.begin(), paths.end(), [](const VerifiedPath& a, const VerifiedPath& b) {
    return a.candidate.margin_min > b.candidate.margin_min;
  });
  if (paths.size() < 3) return;
  const auto fastest = std::min_element(paths.begin() + 1, paths.end(),
                                        [](const VerifiedPath& a, const VerifiedPath& b) {
                                          return a.candidate.duration_s < b.candidate.duration_s;
                                        });
  std::rotate(paths.begin() + 1, fastest, fastest + 1);
}

/// The first two of those searched off doubtful soils, then the first two of all that are left.
std::vector<VerifiedPath> in_order_of_choice(std::vector<VerifiedPath> paths) {
  constexpr std::size_t kBeforeAll = 2;
  std::vector<VerifiedPath> ordered, off_doubt, rest;
  for (VerifiedPath& path : paths) {
    (path.candidate.off_doubtful_soils ? off_doubt : rest).push_back(std::move(path));
  }
  widest_and_fastest_first(off_doubt);
  for (std::size_t i = 0; i < off_doubt.size(); ++i) {
    (i < kBeforeAll ? ordered : rest).push_back(std::move(off_doubt[i]));
  }
  widest_and_fastest_first(rest);
  std::move(rest.begin(), rest.end(), std::back_inserter(ordered));
  return ordered;
}

Standing standing_of(const Candidate& candidate) {
  Standing standing{.value = candidate.margin_min,
                    .high = candidate.margin_min,
                    .off_doubtful_soils = candidate.off_doubtful_soils,
                    .duration_s = candidate.duration_s,
                    .length_m = candidate.length_m};
  if (const auto& spread = candidate.spread) {
    set_by_draws(standing, spread->p05, spread->p05_high, spread->feasible);
  }
  return standing;
}

}  // namespace

std::vector<VerifiedPath> different_paths(std::vector<VerifiedPath> paths, const Vehicle& vehicle,
                                          int most) {
  std::vector<VerifiedPath> chosen;
  for (VerifiedPath& path : in_order_of_choice(std::move(paths))) {
    if (static_cast<int>(chosen.size()) == most) break;
    const auto differs = [&](const VerifiedPath& other) {
      return differ(path.candidate, other.candidate, vehicle);
    };
    const auto faster = [&](const VerifiedPath& other) {
      constexpr double kClearly = 0.9;
      return path.candidate.duration_s < kClearly * other.candidate.duration_s;
    };
    if (std::ranges::all_of(chosen, differs) || std::ranges::all_of(chosen, faster)) {
      chosen.push_back(std::move(path));
    }
  }
  return chosen;
}

void rank(std::vector<VerifiedPath>& paths) {
  std::vector<Standing> standings;
  for (const VerifiedPath& path : paths) standings.push_back(standing_of(path.candidate));
  std::vector<VerifiedPath> ranked;
  for (const std::size_t i : rank_order(standings)) {
    ranked.push_back(std::move(paths[i]));
    ranked.back().candidate.rank = static_cast<int>(ranked.size());
  }
  paths = std::move(ranked);
}

std::vector<std::pair<int, int>> tied_ranks(const std::vector<Candidate>& ranked) {
  std::vector<Standing> standings;
  for (const Candidate& candidate : ranked) standings.push_back(standing_of(candidate));
  return tied_ranks(standings);
}

bool probable_enough(const Candidate& candidate, const Limits& limits) {
  const double shown = candidate.spread ? candidate.spread->feasible.low : 0;
  return shown >= limits.probability_min;
}

double share_counted_on(const Limits& limits) {
  constexpr double kCountedOn = 0.95;
  return limits.probability_min > 0 ? limits.probability_min : kCountedOn;
}

bool is_doubtful(const Candidate& candidate, const Limits& limits) {
  return candidate.spread && candidate.spread->feasible.share < share_counted_on(limits);
}

}  // namespace regoplan
