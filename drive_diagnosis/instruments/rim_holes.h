#pragma once

#include <vector>

#include "drive_diagnosis/recording/drive_recording.h"

namespace regoplan {

/// Of a wheel that tells no speed for longer, nothing is known in between: wheels that brake and
/// gain speed again go no straight line there.
inline constexpr double kRimHole_s = 2.5;

/// Where a wheel that tells its speed otherwise tells none while the recording goes on: windows
/// there are not compared. One finding a wheel.
std::vector<DriveFinding> rim_holes(const std::vector<DriveRecording>& drives);

}  // namespace regoplan
