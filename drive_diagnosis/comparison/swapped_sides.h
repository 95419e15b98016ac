#pragma once

#include <stop_token>
#include <string_view>
#include <vector>

#include "drive_diagnosis/recording/drive_windows.h"
#include "maps/terrain_map.h"
#include "terramech/parameters/vehicle.h"

namespace regoplan {

/// Takes the columns of a quantity (`wheel_speed`, `torque`) of the left side's wheels for those of
/// the wheels across from them, and the other way round; `left` and `right` too. Windows that were
/// read hold what the columns are taken for afterwards.
/// \param vehicle null where the drives have sides only
void exchange_sides(std::string_view quantity, const Vehicle* vehicle,
                    std::vector<DriveRecording>& drives);

/// Whether the vehicle's model comes nearer to the torques of wheels with their sides exchanged, by
/// the squares of what remains beside each wheel's mean. Where wheel speeds were swapped, torques
/// may have been with them, or not. \throws Interrupted
bool torques_are_swapped(const std::vector<DriveRecording>& drives,
                         const std::vector<DriveWindow>& windows, const TerrainMap& map,
                         const Vehicle& vehicle, double gravity_mps2, int threads,
                         const std::stop_token& stop);

}  // namespace regoplan
