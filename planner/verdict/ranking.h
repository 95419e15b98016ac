#pragma once

#include <utility>
#include <vector>

#include "planner/verdict/verified_path.h"

namespace regoplan {

/// Of paths that passed, at most so many that really differ: each strays from every other by at
/// least the vehicle's width (of a wide one 2 m) and 4 % of the way somewhere, or is faster than
/// all before it by more than a tenth. The one with the largest margin comes first, then the
/// fastest, then the others from the largest margin down. Where some were searched off doubtful
/// soils, the first two of these come before all: what the others cross is doubtful.
std::vector<VerifiedPath> different_paths(std::vector<VerifiedPath> paths, const Vehicle& vehicle,
                                          int most);

/// Ranks by `rank_order`: by the soils' draws; paths without draws come last, by their margin at
/// the mean soils. Numbers the ranks from 1.
void rank(std::vector<VerifiedPath>& paths);

/// Ranks that the draws cannot tell apart: first and last of each group of two and more that are
/// tied. \param ranked in the order of their ranks
std::vector<std::pair<int, int>> tied_ranks(const std::vector<Candidate>& ranked);

/// Whether a candidate keeps the chance constraint: the lower end of its probability's interval
/// counts. What was not drawn keeps none but that of 0.
bool probable_enough(const Candidate& candidate, const Limits& limits);

/// The share of draws that somebody counts on: what the chance constraint asks, .95 where there is
/// none.
double share_counted_on(const Limits& limits);

/// Whether fewer of its draws hold than that.
bool is_doubtful(const Candidate& candidate, const Limits& limits);

}  // namespace regoplan
