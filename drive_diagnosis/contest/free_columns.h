#pragma once

#include <Eigen/Core>

#include "drive_diagnosis/contest/effect_contest.h"

namespace regoplan {

inline constexpr double kFault = 8;  ///< a fault's deviation, in those of a sound vehicle

/// All that varies in a contest without a name, as columns of deviation 1: parameters first, then
/// the numbers of each known zone's soil, then the ground.
Eigen::MatrixXd free_columns(const EffectContest& contest);

}  // namespace regoplan
