#pragma once

#include <vector>

#include "drive_diagnosis/recording/drive_recording.h"
#include "drive_diagnosis/recording/drive_windows.h"
#include "terramech/parameters/vehicle.h"

namespace regoplan {

/// Drives whose torques no soil under this vehicle takes: they are told in another unit than N m.
/// Held against what it takes to slide a wheel, its load times its radius: in the root mean square
/// over windows that move, wheels take more than a thousandth of it, that of a train on rails, and
/// less than three times as much.
std::vector<DriveFinding> doubtful_torque_units(const std::vector<DriveRecording>& drives,
                                                const std::vector<DriveWindow>& windows,
                                                const Vehicle& vehicle, double gravity_mps2);

/// Takes the torques of wheels out of drives; their windows are to be read anew.
void leave_torques_out(std::vector<DriveRecording>& drives);

}  // namespace regoplan
