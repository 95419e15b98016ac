#pragma once

#include <optional>

#include "planner/driving/replay_steps.h"
#include "planner/problem/world.h"

namespace regoplan {

/// Why a vehicle cannot stop from a state: braking as hard as it brakes, the steering held or
/// straightened, the first limit that it breaks before it is at rest (that of the steering held,
/// where both fail). Nothing where it can.
std::optional<RejectedState> refused_stop(const World& world, const VehicleState& from,
                                          const ReplaySteps& steps);

}  // namespace regoplan
