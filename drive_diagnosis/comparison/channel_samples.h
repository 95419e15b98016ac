#pragma once

#include <string>

#include "drive_diagnosis/recording/drive_windows.h"

namespace regoplan {

/// How far single samples of a channel scatter, in its unit; 0 of a channel that is not there.
/// Torques jump where a follower steers anew: that is motion, which the model has as well, and no
/// noise. What stands says 0 and nothing of scatter.
double sample_std(const DriveRecording& drive, const std::string& name);

/// How many samples of a channel a window has.
int samples_in(const DriveRecording& drive, const DriveWindow& window, const std::string& name);

/// Root mean square of a channel's samples in a window; 0 where it has none.
double mean_size(const DriveRecording& drive, const DriveWindow& window, const std::string& name);

/// How far a window's mean of a channel may err as nobody knows when within a step from sample to
/// sample the channel changed: by half of each step at most. \param sample_std that is no step
double step_error(const DriveRecording& drive, const DriveWindow& window, const std::string& name,
                  double sample_std);

}  // namespace regoplan
