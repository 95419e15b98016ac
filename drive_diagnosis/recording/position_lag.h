#pragma once

#include <optional>

#include "drive_diagnosis/recording/drive_recording.h"

namespace regoplan {

/// How long positions come after the wheel speeds that made them, within 3 s: the shift at which
/// the ways between positions a second apart are what the wheels rolled, but for one factor.
/// Nothing where the drive does not show it clearly, or less than .5 s: a body follows its wheels
/// by some tenths of a second. Accuracy .2 s (test PositionLag).
std::optional<double> position_lag_s(const DriveRecording& drive);

/// Brings positions that come late back to the rows in which they were true. Told as a finding.
void mend_position_lag(DriveRecording& drive);

}  // namespace regoplan
