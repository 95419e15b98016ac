#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "drive_diagnosis/contest/effect_contest.h"

namespace regoplan {

/// By how many nats parameters that are fitted to the other windows make stretches of windows, held
/// out one at a time, likelier than they are with these parameters as they are said to be; all else
/// is fitted to the other windows either way. The stretches are consecutive shares of the windows
/// in which the parameters change anything. 0 where that is one window at most: it can be held
/// against no other. \param together indices of the parameters \param channels that each window has
double held_out_nats(const EffectContest& contest, const std::vector<std::size_t>& together,
                     Eigen::Index channels);

}  // namespace regoplan
