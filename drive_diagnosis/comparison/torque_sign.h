#pragma once

#include <stop_token>
#include <string>
#include <vector>

#include "drive_diagnosis/recording/drive_windows.h"
#include "maps/terrain_map.h"
#include "terramech/parameters/vehicle.h"

namespace regoplan {

/// A wheel whose torque is told with the other sign, and the drives in which it is, in their order.
struct ReversedTorque {
  std::string wheel;
  std::vector<std::size_t> drives;
};

/// The vehicle's model comes far nearer to such a torque with the other sign (a quarter of the
/// squares and less), and so do its changes from window to window: drag on a descent turns a torque
/// round, but not its changes. Each drive of at least 12 windows is judged by itself, as a logger
/// may be mounted anew between two; shorter ones follow those where they agree.
/// \throws Interrupted
std::vector<ReversedTorque> wheels_with_torque_reversed(const std::vector<DriveRecording>& drives,
                                                        const std::vector<DriveWindow>& windows,
                                                        const TerrainMap& map,
                                                        const Vehicle& vehicle, double gravity_mps2,
                                                        int threads, const std::stop_token& stop);

/// Turns the sign of a wheel's torque in those recordings and in the means of their windows.
void reverse_torque(const ReversedTorque& reversed, std::vector<DriveRecording>& drives,
                    std::vector<DriveWindow>& windows);

}  // namespace regoplan
