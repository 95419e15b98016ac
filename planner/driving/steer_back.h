#pragma once

#include <vector>

#include "planner/driving/replay.h"

namespace regoplan {

/// The control that brings a vehicle back to where it should be at this moment:
///   curvature = commanded curvature - offset / L^2 - 2 (heading error) / L
///   speed     = commanded speed - (distance ahead) / 1 s
/// with the offset to the left, L twice the longest arm of a wheel, both in the
/// frame of where it should be; in reverse the heading's term has the other sign. Errors below
/// 2 cm and .01 rad are left alone. Within the vehicle's curvature; no faster than commanded or 95
/// % of the speed limit; at rest nothing is corrected.
VehicleControl steered_back(const PlanningProblem& problem, const VehicleControl& commanded,
                            const VehicleState& due, const VehicleState& actual);

/// Controls that keep to a path although the world answers a little otherwise than the one that it
/// was searched in: driven once in this world, steered back at every coarse step. Replayed in this
/// world with the same steps, they lead where this drive led.
/// \param searched its states after every coarse step, the start first
std::vector<ControlSegment> steered_back(const World& world, const ReplaySteps& steps,
                                         const std::vector<ControlSegment>& controls,
                                         const std::vector<VehicleState>& searched);

}  // namespace regoplan
