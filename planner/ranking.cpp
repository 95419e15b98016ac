#include "planner/ranking.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <tuple>

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

bool differ(const Candidate& path, const Candidate& other) {
  constexpr double kLeast_m = 2, kShareOfWay = 0.04;
  const double apart = std::max(stray_m(path, other), stray_m(other, path));
  return apart >= std::max(kLeast_m, kShareOfWay * other.length_m);
}

/// What a path is ranked by, before time and length: first the kind, the smaller the better, then
/// the value, the larger the better.
struct Standing {
  enum Kind { kQuantile, kShareOfDraws, kMarginAtMean } kind = kMarginAtMean;
  double value = 0;
  double high = 0;  ///< upper end of the value's sampling error
};

Standing standing_of(const Candidate& candidate) {
  const std::optional<MarginSpread>& spread = candidate.spread;
  if (!spread) return {Standing::kMarginAtMean, candidate.margin_min, candidate.margin_min};
  if (spread->p05 > MarginSpread::kBroken) {
    return {Standing::kQuantile, spread->p05, spread->p05_high};
  }
  return {Standing::kShareOfDraws, spread->feasible.share, spread->feasible.high};
}

}  // namespace

std::vector<VerifiedPath> different_paths(std::vector<VerifiedPath> paths, int most) {
  const auto wider = [](const VerifiedPath& a, const VerifiedPath& b) {
    return a.candidate.margin_min > b.candidate.margin_min;
  };
  const auto faster = [](const VerifiedPath& a, const VerifiedPath& b) {
    return a.candidate.duration_s < b.candidate.duration_s;
  };
  std::stable_sort(paths.begin(), paths.end(), wider);
  if (paths.size() > 2) {
    const auto fastest = std::min_element(paths.begin() + 1, paths.end(), faster);
    std::rotate(paths.begin() + 1, fastest, fastest + 1);
  }
  std::vector<VerifiedPath> chosen;
  for (VerifiedPath& path : paths) {
    if (static_cast<int>(chosen.size()) == most) break;
    const auto differs = [&](const VerifiedPath& other) {
      return differ(path.candidate, other.candidate);
    };
    if (std::all_of(chosen.begin(), chosen.end(), differs)) chosen.push_back(std::move(path));
  }
  return chosen;
}

void rank(std::vector<VerifiedPath>& paths) {
  const auto better = [](const VerifiedPath& a, const VerifiedPath& b) {
    const Standing one = standing_of(a.candidate), other = standing_of(b.candidate);
    return std::tuple(one.kind, -one.value) < std::tuple(other.kind, -other.value);
  };
  const auto sooner = [](const VerifiedPath& a, const VerifiedPath& b) {
    return std::tuple(a.candidate.duration_s, a.candidate.length_m) <
           std::tuple(b.candidate.duration_s, b.candidate.length_m);
  };
  for (auto group = paths.begin(); group != paths.end();) {
    const Standing leader = standing_of(std::min_element(group, paths.end(), better)->candidate);
    const auto rest = std::stable_partition(group, paths.end(), [&](const VerifiedPath& path) {
      const Standing standing = standing_of(path.candidate);
      return standing.kind == leader.kind && standing.high >= leader.value;
    });
    std::stable_sort(group, rest, sooner);
    group = rest;
  }
  for (std::size_t i = 0; i < paths.size(); ++i) {
    paths[i].candidate.rank = static_cast<int>(i) + 1;
  }
}

}  // namespace regoplan
