#pragma once

#include <vector>

#include "planner/verified_path.h"

namespace regoplan {

/// Of paths that passed, at most so many that really differ: each strays from every other by at
/// least 2 m and 4 % of the way somewhere. The one with the largest margin comes first, then the
/// fastest, then the others from the largest margin down.
std::vector<VerifiedPath> different_paths(std::vector<VerifiedPath> paths, int most);

/// Ranks from the best down. The best of those left by the 5 % quantile of the smallest margin over
/// the soils' draws leads a group: whoever lies within its own sampling error of the leader is tied
/// with it. In a group the faster ranks first, then the shorter. Paths whose quantile says that
/// limits are broken (`MarginSpread::kBroken`) come after all others and are grouped by the share
/// of draws that hold; paths without draws come last, by their margin at the mean soils. Numbers
/// the ranks from 1.
void rank(std::vector<VerifiedPath>& paths);

}  // namespace regoplan
