#pragma once

#include "drive_diagnosis/recording/drive_recording.h"

namespace regoplan {

/// Puts the clock of a drive right, so that its time rises from row to row: rows in reverse order
/// (nine in ten and more) are turned round, shuffled ones sorted; single rows out of order (time
/// returns to where it was within three rows) and repeated times are left out; where the clock was
/// set back for good, what follows counts on from there. Each is told as a finding.
void mend_time(DriveRecording& drive);

/// Takes out positions that only repeat the one before (stale), and those that jump: off the track
/// that goes on after them (`fix_jumps`), or farther from the median of the fixes around than a
/// vehicle of twice that speed can be. Steps after which positions go on with another datum are
/// taken back. Told as findings.
/// \param speed_max_mps what the vehicle can do at most
void mend_positions(DriveRecording& drive, double speed_max_mps);

/// The median step of the clock from row to row; a tenth of a second where there is none.
double median_step_s(const DriveRecording& drive);

/// By how much times may be off the even ticks of a clock, if only by rounding, without a row
/// changing sides: a quarter of the median step.
double clock_slack_s(const DriveRecording& drive);

/// The largest gap that does not end a stretch of a recording: ten times the median step, and 1 s
/// at least, within the slack of the clock.
double gap_max_s(const DriveRecording& drive);

}  // namespace regoplan
