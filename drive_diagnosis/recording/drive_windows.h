#pragma once

#include <cstddef>
#include <vector>

#include "drive_diagnosis/recording/drive_recording.h"
#include "drive_diagnosis/recording/sample_smoothing.h"

namespace regoplan {

/// Slower, a drive is taken to stand, where it usually goes at .4 m/s or faster: positions and rim
/// speeds scatter by as much. Speeds and rates of slower drives go by their `pace`.
inline constexpr double kMoving_mps = 0.1;

/// A place on the map, m.
struct MapPlace {
  double x_m = 0, y_m = 0;
};

/// A part of the time that a window is smoothed over. What is smoothed is a linear functional of
/// what happened: the shares say how much of it is the mean of each part, so that a prediction can
/// be made the same functional as the measurement.
struct WindowPart {
  double start_s = 0, end_s = 0;
  double x_m = 0, y_m = 0, yaw_rad = 0;  ///< smoothed, in its middle
  double track_share = 0;                ///< of the velocity over ground, `forward_mps`, `left_mps`
  double turn_share = 0;                 ///< of the yaw rate
  double mean_share = 0;                 ///< of the channels' means
};

/// What a drive did over a few seconds, from its fresh samples alone. NaN where the drive does not
/// say.
struct DriveWindow {
  std::size_t drive = 0;  ///< index of its drive
  double pace = 1;        ///< of its drive (`pace_of`)
  double start_s = 0, end_s = 0;
  /// What is smoothed may begin before the window and end after it.
  double smoothed_from_s = 0, smoothed_to_s = 0;
  /// Smoothed over that time, about the middle: the track, off a place of its own, and the yaw.
  struct Track {
    double x0_m = 0, y0_m = 0;
    SampleSmoothing x = {}, y = {};

    MapPlace at(double off_s) const { return {x0_m + x.at(off_s), y0_m + y.at(off_s)}; }
  } track = {};
  SampleSmoothing yaw = {};
  double x_m = 0, y_m = 0;  ///< in the middle
  double yaw_rad = 0;
  double pitch_rad = 0, roll_rad = 0;
  double speed_mps = 0;         ///< horizontal, along the track; from positions
  double sensed_speed_mps = 0;  ///< mean of the channel `speed_mps`
  double forward_mps = 0;       ///< horizontal, along the measured yaw
  double left_mps = 0;
  double acceleration_mps2 = 0;          ///< along the track
  double wheel_acceleration_rad_s2 = 0;  ///< of the wheels' mean turning rate
  double yaw_rate_rad_s = 0;
  double course_rad = 0;
  double speed_std_mps = 0;  ///< of the smoothing, from the scatter of the fixes
  double yaw_rate_std_rad_s = 0;
  /// Standard deviations of what is smoothed, by that of a single fix: of the velocity, of the yaw
  /// in the middle and of the yaw rate. They are larger where the smoothing has fewer fixes, or all
  /// to one side of the window, as where a recording begins or ends.
  double velocity_by_fix_1ps = 0, yaw_by_fix = 0, yaw_rate_by_fix_1ps = 0;
  int fixes = 0;
  bool steady = false;           ///< no command changes within it
  std::vector<double> channels;  ///< means, in the order of the drive's channels

  double duration_s() const { return end_s - start_s; }
  double middle_s() const { return (start_s + end_s) / 2; }
  /// Where it was at a time off the middle: smoothed, or straight on where too few fixes were.
  MapPlace place_at(double off_s) const;
  /// So many parts of equal length of what is smoothed; their shares sum to 1.
  std::vector<WindowPart> divided(std::size_t count) const;
};

/// The windows of a drive, one behind the other; none spans a gap of the recording. Positions and
/// yaw are smoothed by a parabola over the window; what has fewer than three fixes has no speed
/// from positions. \param beyond share of a window by which the smoothing reaches beyond it on
/// either side, where the recording goes on
std::vector<DriveWindow> drive_windows(const DriveRecording& drive, std::size_t index,
                                       double window_s, double beyond = 0);

/// The mean of a channel in a window; NaN where the drive has none.
double channel_mean(const DriveRecording& drive, const DriveWindow& window,
                    std::string_view channel);

}  // namespace regoplan
