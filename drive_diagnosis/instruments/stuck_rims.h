#pragma once

#include <vector>

#include "drive_diagnosis/recording/drive_recording.h"

namespace regoplan {

/// Leaves out a wheel's speeds while they repeat one value for at least 5 s and 20 rows and those
/// of the other wheels go on changing, as of an encoder that has stopped telling; windows are to be
/// read anew. \returns what is to be told of it
std::vector<DriveFinding> leave_stuck_rims_out(std::vector<DriveRecording>& drives);

}  // namespace regoplan
