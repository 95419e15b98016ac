#pragma once

#include <stop_token>
#include <string>
#include <vector>

#include "drive_diagnosis/recording/drive_windows.h"
#include "maps/terrain_map.h"
#include "terramech/parameters/vehicle.h"

namespace regoplan {

/// Names of the wheels whose torque is told with the other sign: the vehicle's model comes far
/// nearer to it so (a quarter of the squares and less, over at least 12 windows). No payload, drag
/// or soil turns a wheel's torque round.
/// \throws Interrupted
std::vector<std::string> wheels_with_torque_reversed(const std::vector<DriveRecording>& drives,
                                                     const std::vector<DriveWindow>& windows,
                                                     const TerrainMap& map, const Vehicle& vehicle,
                                                     double gravity_mps2, int threads,
                                                     const std::stop_token& stop);

/// Turns the sign of a wheel's torque in recordings and in the means of their windows.
void reverse_torque(const std::string& wheel, std::vector<DriveRecording>& drives,
                    std::vector<DriveWindow>& windows);

}  // namespace regoplan
