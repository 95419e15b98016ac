#pragma once

#include <vector>

#include "drive_diagnosis/recording/drive_recording.h"
#include "drive_diagnosis/recording/drive_windows.h"

namespace regoplan {

/// Whether a drive's yaw is told in radians in a column of degrees: no number of it goes beyond
/// what radians of a full turn are, and taken for radians it looks along the track or back along
/// it, within 10 deg in the median over at least 4 windows that move, while as it is told it lies 5
/// deg and three times as far off.
bool yaw_is_in_radians(const DriveRecording& drive, std::size_t index,
                       const std::vector<DriveWindow>& windows);

/// Takes the yaw of such drives for what it is; their windows are to be read anew.
/// \returns a finding for each
std::vector<DriveFinding> mend_yaw_in_radians(std::vector<DriveRecording>& drives,
                                              const std::vector<DriveWindow>& windows);

}  // namespace regoplan
