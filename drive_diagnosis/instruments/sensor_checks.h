#pragma once

#include <string>
#include <vector>

#include "drive_diagnosis/recording/drive_recording.h"
#include "drive_diagnosis/recording/drive_windows.h"

namespace regoplan {

/// What is known of the vehicle before its drives are looked at.
struct SideGeometry {
  std::vector<std::string> left_wheels, right_wheels;  ///< names; `left` and `right` need none
};

/// Whether pairs without any relation reach such a correlation less than once in a million times.
bool is_sure(double r, std::size_t n);

/// What only the drives together can show of a vehicle's instruments. Every check needs at least
/// `kChecked` windows that move, and a correlation that chance gives once in a million.
struct SensorChecks {
  static constexpr std::size_t kChecked = 12;
  std::vector<DriveFinding> findings;
  /// What the yaw channel must be multiplied by to turn from +x toward +y: -1 for a compass.
  double yaw_sign = 1;
  double yaw_offset_rad = 0;  ///< yaw_sign * yaw + offset looks along the track
  bool wheel_sides_swapped = false;
  bool current_sides_swapped = false;
  double sensed_speed_per_mps = 1;  ///< 1.944 where the log's speed is in knots
};

/// Signs, units and sides: yaw against the track, the speed channel against positions (knots,
/// km/h), wheel speeds and currents of the sides against the turning.
SensorChecks check_sensors(const std::vector<DriveRecording>& drives,
                           const std::vector<DriveWindow>& windows, const SideGeometry& sides);

/// The mean over the wheels of a side of a quantity, `wheel_speed`, `current`, `torque`; NaN where
/// there is none.
double side_mean(const DriveRecording& drive, const DriveWindow& window, std::string_view quantity,
                 std::string_view unit, const std::vector<std::string>& wheels,
                 std::string_view side);

}  // namespace regoplan
