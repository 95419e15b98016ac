#pragma once

#include <optional>
#include <string>
#include <vector>

#include "drive_diagnosis/comparison/window_prediction.h"
#include "drive_diagnosis/recording/drive_recording.h"

namespace regoplan {

/// What the wheels of a drive were set to over the time that a window is smoothed over, and where
/// the vehicle was: in parts of equal length, in finer ones where wheels begin or end to brake or
/// to gain speed. Slip follows the wheels within less than a second, which parts of .6 s do not
/// resolve where acceleration jumps: speeds were .005 m/s off there
/// (WindowComparison.SlipIsFollowedWhereAVehicleBeginsToBrake).
/// \returns nothing where the drive lacks some of it
std::optional<WindowInput> input_of(const DriveRecording& drive, const DriveWindow& window,
                                    const Vehicle& vehicle, double gravity_mps2);

/// The columns of a drive's format that `input_of` takes and that have no value in a window.
std::vector<std::string> columns_missing(const DriveRecording& drive, const DriveWindow& window,
                                         const Vehicle& vehicle);

/// Slower, wheels are taken to stand, but for the pace of their drive.
inline constexpr double kStanding_mps = kMoving_mps / 2;

/// Whether wheels stand or turn round somewhere: they have no slip to speak of there.
bool stands(const WindowInput& input);

}  // namespace regoplan
