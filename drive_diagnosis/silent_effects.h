#pragma once

#include <vector>

#include "drive_diagnosis/drive_diagnosis.h"

namespace regoplan {

/// Says what nobody should expect these drives to show, and the drive that would.
void say_what_is_silent(const DriveSetup& setup, const std::vector<DriveRecording>& drives,
                        DriveDiagnosis& result);

}  // namespace regoplan
