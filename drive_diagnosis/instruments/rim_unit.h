#pragma once

#include <vector>

#include "drive_diagnosis/recording/drive_recording.h"
#include "drive_diagnosis/recording/drive_windows.h"

namespace regoplan {

/// Takes wheel speeds that are told in turns a minute or degrees a second, as wheels of that radius
/// that roll along the track show, for what they are; windows are to be read anew. Slip is told
/// from a unit as long as it is below 0.3. Drives of fewer than 12 windows that move follow the
/// others. \returns what is to be told of it
std::vector<DriveFinding> mend_rim_units(std::vector<DriveRecording>& drives,
                                         const std::vector<DriveWindow>& windows,
                                         double wheel_radius_m);

}  // namespace regoplan
