#pragma once

#include <vector>

#include "drive_diagnosis/recording/drive_recording.h"
#include "drive_diagnosis/recording/drive_windows.h"
#include "terramech/parameters/vehicle.h"

namespace regoplan {

/// Takes steering angles (and `curvature_1pm`) that are told with the other sign, in radians in a
/// column of degrees, or multiplied by radians per degree once more, for what they are, all of
/// them, those of an axle, or one; windows are to be read anew.
///
/// The angle at which the vehicle goes over the ground and the curvature on which it turns, by
/// poses, are held against those of wheels that are steered as told: a vehicle that crabs goes as
/// it is steered. What is the same in all windows (offsets, how the yaw is mounted; so of one
/// circle nothing is said) and what goes with the roll (a vehicle that slides down a slope that it
/// is steered up) is taken off. Another sign or unit must leave a quarter of the squares of both
/// and less, and less than no steering would. Each drive of at least 12 windows that move is judged
/// by itself; shorter and straighter ones follow those where they agree.
/// \returns what is to be told of it
std::vector<DriveFinding> mend_steering(std::vector<DriveRecording>& drives,
                                        const std::vector<DriveWindow>& windows,
                                        const Vehicle& vehicle);

}  // namespace regoplan
