#pragma once

#include <vector>

#include "drive_diagnosis/drive_diagnosis.h"

namespace regoplan {

/// Drives whose windows are off together what the fit to all of them says, far beyond what windows
/// of one drive scatter: something is otherwise in some of the drives only, which no fault or soil
/// of all of them is. One finding for each channel that shows it, of the drive that is farthest
/// off; and one for each of several drives that zones cover nearly all of, which a payload or a
/// fault of that drive alone looks like.
std::vector<DriveFinding> differing_drives(const std::vector<DriveRecording>& drives,
                                           const std::vector<DriveWindow>& windows,
                                           const VehicleEffects& effects);

}  // namespace regoplan
