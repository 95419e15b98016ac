#pragma once

#include <optional>
#include <vector>

#include "drive_diagnosis/drive_recording.h"
#include "drive_diagnosis/drive_windows.h"
#include "terramech/parameters/vehicle.h"

namespace regoplan {

/// Torques of wheels that no soil under this vehicle takes: they are told in another unit than
/// N m. Held against what it takes to slide a wheel, its load times its radius: in the root mean
/// square over windows that move, wheels take more than a thousandth of it, that of a train on
/// rails, and less than three times as much. Nothing where they do, or where none is recorded.
std::optional<DriveFinding> doubtful_torque_unit(const std::vector<DriveRecording>& drives,
                                                 const std::vector<DriveWindow>& windows,
                                                 const Vehicle& vehicle, double gravity_mps2);

/// Takes the torques of wheels out of drives.
void leave_torques_out(std::vector<DriveRecording>& drives);

}  // namespace regoplan
