#pragma once

#include <vector>

#include "drive_diagnosis/instruments/sensor_checks.h"
#include "drive_diagnosis/recording/drive_recording.h"
#include "drive_diagnosis/recording/drive_windows.h"

namespace regoplan {

/// Turns the sign of wheel speeds that are told backwards where a drive goes the way that its yaw
/// looks; its windows are to be read anew. A vehicle that does drive backwards, with a yaw that
/// looks along the track, tells the same while it goes straight on: more than half of the wheels
/// are turned only where their sides then run in turns as they must, or where the commanded speed
/// says forwards. Each drive of at least 12 windows that move is judged by itself; shorter ones
/// follow those where they agree. \returns what is to be told of it
std::vector<DriveFinding> mend_rim_signs(std::vector<DriveRecording>& drives,
                                         const std::vector<DriveWindow>& windows,
                                         const SideGeometry& sides);

}  // namespace regoplan
