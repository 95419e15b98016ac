#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace regoplan {

/// Which ranks are none, as the draws of the soils, or without draws the margins at their means,
/// cannot tell their paths apart; empty where each is one.
/// \param tied first and last rank of each group \param is_drawn whether the path of a rank was
/// judged over draws
std::string tie_sentence(const std::vector<std::pair<int, int>>& tied,
                         const std::function<bool(int rank)>& is_drawn);

}  // namespace regoplan
