#pragma once

#include "drive_diagnosis/recording/drive_recording.h"

namespace regoplan {

/// How far a single fix of a drive scatters, standard deviations.
struct FixScatter {
  double position_m = 0;  ///< of either coordinate
  double yaw_rad = 0;
};

/// From neighbouring fixes over the whole drive; 0 of what has fewer than five.
FixScatter fix_scatter(const DriveRecording& drive);

}  // namespace regoplan
