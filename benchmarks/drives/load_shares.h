#pragma once

#include <array>
#include <vector>

#include "terramech/vehicle/vehicle_dynamics.h"

namespace regoplan::drives {

/// Load of each wheel for a normal force, a force along and one to the left, of one newton each: on
/// springs alike, or on the rockers and bogies that the vehicle has.
std::vector<std::array<double, 3>> load_shares(const Vehicle& vehicle);

}  // namespace regoplan::drives
