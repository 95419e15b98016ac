#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "planner/runtime/draw_statistics.h"

namespace regoplan {

/// What a path is ranked by.
struct Standing {
  /// The smaller ranks first, whatever the value.
  enum Tier { kByQuantile, kByShareOfDraws, kByMarginAtMeanSoils, kInfeasible };

  Tier tier = kByMarginAtMeanSoils;
  double value = 0;  ///< the larger the better
  double high = 0;   ///< upper end of the value's own sampling error
  bool off_doubtful_soils = false;
  double duration_s = 0;
  double length_m = 0;
};

/// Puts the tier and value of a path's draws into a standing: by the 5 % quantile of the smallest
/// margin, or by the share of draws that hold where that quantile says that limits are broken.
/// \param p05_high upper end of the quantile's interval
void set_by_draws(Standing& standing, double p05, double p05_high, const Probability& feasible);

/// Whether draws do not tell a path from a better one: both are of one tier, and the other lies
/// within its own sampling error of the leader.
bool tied(const Standing& leader, const Standing& other);

/// Whether a standing comes first, whatever the sampling error.
bool leads(const Standing& a, const Standing& b);

/// Indices from the best down, in groups. The best of those left leads a group, and whoever is tied
/// with it belongs to it. In a group the faster
/// ranks first, then the shorter; where limits break in draws, those off doubtful soils before
/// them.
std::vector<std::vector<std::size_t>> rank_groups(const std::vector<Standing>& standings);

/// Ranks that are tied: first and last of each group of two and more, counted from 1.
std::vector<std::pair<int, int>> tied_ranks(const std::vector<Standing>& standings);

/// The same without the groups.
std::vector<std::size_t> rank_order(const std::vector<Standing>& standings);

}  // namespace regoplan
