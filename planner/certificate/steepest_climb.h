#pragma once

#include <optional>
#include <vector>

#include "planner/problem/world.h"

namespace regoplan {

/// For each soil of a world's map the steepest slope that the vehicle climbs, straight and slowly,
/// within its limits and with the margins that the problem asks for, radians; nothing where it
/// cannot even drive on the level. To 1/16 of the largest slope allowed.
std::vector<std::optional<double>> steepest_climbs_rad(const World& world);

}  // namespace regoplan
