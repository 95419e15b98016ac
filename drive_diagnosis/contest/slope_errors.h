#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "drive_diagnosis/contest/effect_contest.h"

namespace regoplan {

/// What errors of the map's slopes change in each window by one standard deviation, in white data:
/// window by window, its channels one behind the other.
struct SlopeErrors {
  Eigen::VectorXd along, across;
  Eigen::Index channels = 0;
};

/// Independent columns that stand for them. Where a map's heights err by so much at a place,
/// whatever they do further on, the error of the slope along a window is the difference of two
/// heights, and that along the next begins with the second: over a long stretch slopes do not err.
/// \param follows whether a window follows the one before
/// \param persistent share of the variance along the way that has nothing to do with the windows
/// before and after, 0 to 1; across, all of it
Eigen::MatrixXd slope_error_columns(const SlopeErrors& errors, const std::vector<bool>& follows,
                                    double persistent);

/// How much of them persists, as what is measured in some channels makes likeliest; where they say
/// nothing, all of it, which takes the least for granted.
/// \param contest zones and faults that it knows are free
/// \param channels that are asked, of those that each window has
double likely_persistence(const EffectContest& contest, const SlopeErrors& errors,
                          const std::vector<Eigen::Index>& channels);

}  // namespace regoplan
