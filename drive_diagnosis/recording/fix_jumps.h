#pragma once

#include <cstddef>
#include <vector>

#include "drive_diagnosis/recording/drive_recording.h"

namespace regoplan {

/// A fix that lies off the track of those around it.
struct FixJump {
  std::size_t row = 0;
  double off_m = 0;
};

/// Single fixes, or a few in a row for a second or so, that leave the track and come back to it:
/// farther off the cubic through two fixes before and two after than fixes of this recording
/// scatter about it and than the vehicle's way there bends. Where positions stay away, as of
/// another datum, or the fixes around do not go on from one another, nothing jumps.
/// \param rows of the fixes, in order of their time
/// \param speed_max_mps what the vehicle can do at most
std::vector<FixJump> fix_jumps(const DriveRecording& drive, std::vector<std::size_t> rows,
                               double speed_max_mps);

/// Of fixes farther apart in time, hardly anything is known of what was between them: those at
/// half a hertz are not, however their stamps scatter.
inline constexpr double kFixesApart_s = 2.5;

}  // namespace regoplan
