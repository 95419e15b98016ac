#pragma once

#include <stop_token>
#include <string_view>
#include <vector>

#include "drive_diagnosis/instruments/exchanged_rims.h"
#include "drive_diagnosis/recording/drive_windows.h"
#include "maps/terrain_map.h"
#include "terramech/parameters/vehicle.h"

namespace regoplan {

/// Wheels across from each other, and `left` and `right`.
/// \param vehicle null where the drives have sides only
std::vector<WheelPair> sides_across(const Vehicle* vehicle);

/// Takes the columns of a quantity (`wheel_speed`, `torque`) of the first of each pair for those of
/// the second, and the other way round. Windows that were read hold what the columns are taken for
/// afterwards.
void exchange(std::string_view quantity, const std::vector<WheelPair>& pairs,
              std::vector<DriveRecording>& drives);

/// Whether the vehicle's model comes nearer to the torques of wheels with these pairs exchanged, by
/// the squares of what remains beside each wheel's mean. Where wheel speeds were swapped, torques
/// may have been with them, or not. \throws Interrupted
bool torques_are_swapped(const std::vector<DriveRecording>& drives,
                         const std::vector<DriveWindow>& windows, const TerrainMap& map,
                         const Vehicle& vehicle, double gravity_mps2,
                         const std::vector<WheelPair>& pairs, int threads,
                         const std::stop_token& stop);

}  // namespace regoplan
