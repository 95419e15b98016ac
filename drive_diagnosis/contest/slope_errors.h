#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
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

/// The columns that make the measured pitch most likely, which no soil changes; where it says
/// nothing, all of it persists: other scatter of torques, which goes the same way, does.
/// \param pitch the channel that it is; nothing: not measured
Eigen::MatrixXd likely_slope_errors(const EffectContest& contest, const SlopeErrors& errors,
                                    std::optional<std::size_t> pitch);

}  // namespace regoplan
