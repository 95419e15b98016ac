#pragma once

#include <optional>
#include <string>

#include "planner/problem/world.h"

namespace regoplan {

/// Why the vehicle comes to grief whatever it does at its start speed: each of a fan of drives,
/// braking and holding the speed on curvatures from lock to lock, ends in a state that may not be
/// before it stops or has turned round by a quarter. Margins are left aside. Nothing where some
/// drive gets away. Names a reason; it is no proof, as steering may vary on the way.
std::optional<std::string> crash_ahead(const World& world);

}  // namespace regoplan
