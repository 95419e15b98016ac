#pragma once

#include <Eigen/Core>

#include "drive_diagnosis/contest/effect_contest.h"

namespace regoplan {

/// Deviation of a fault, in those of a sound vehicle: while it competes, and once it is claimed.
/// What is certainly there may have any size; held to what competes well, a drag of 12 N m on a
/// lunar rover was told as 10.3 (9.1 to 11.6), and another fault took the rest.
inline constexpr double kFault = 8, kClaimedFault = 200;

/// All that varies in a contest without a name, as columns of deviation 1: parameters first, then
/// the numbers of each known zone's soil, then the ground.
Eigen::MatrixXd free_columns(const EffectContest& contest);

}  // namespace regoplan
