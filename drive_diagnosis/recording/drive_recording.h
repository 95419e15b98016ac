#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace regoplan {

/// Stands for a value that was not sampled, or that samples do not give.
inline constexpr double kNotSampled = std::numeric_limits<double>::quiet_NaN();

/// One sensed quantity of a drive, a value a row; NaN where it was not sampled.
struct DriveChannel {
  std::string name;  ///< ends in its unit, SI and radians: `pitch_rad`, `current_left_a`
  std::vector<float> values;
};

/// Something about a recording or a vehicle that a person should know.
struct DriveFinding {
  std::string id;     ///< `stale_position`, `lag`, `swapped_sides`, `sign`, `unit`, `jump`, ...
  std::string drive;  ///< the drive it was found in
  std::string text;   ///< one sentence
  std::optional<double> value = {};
  std::string unit = {};
  bool mended = false;  ///< the recording was put right before it was used
};

/// The recording of one drive: what the vehicle's sensors said, over time. Map frame: x east, y
/// north, metres; yaw from +x toward +y, pitch nose up, roll left side up, radians.
struct DriveRecording {
  std::string drive_id;
  std::string file;
  std::string day;               ///< empty where nobody says
  std::vector<double> time_s;    ///< rises from row to row
  std::vector<double> x_m, y_m;  ///< NaN where the position was not sampled
  std::vector<DriveChannel> channels;
  std::vector<std::string> ignored;  ///< columns that say nothing here
  std::vector<DriveFinding> findings;
  std::int64_t rows_read = 0;
  int rows_per_sample = 1;  ///< more than 1 where so many rows were averaged into one

  std::size_t size() const { return time_s.size(); }
  /// Null where the drive has no such channel.
  const DriveChannel* channel(std::string_view name) const;
  DriveChannel* channel(std::string_view name);
};

/// Multiplies recorded torques of wheels by so much, and makes torques of currents of wheels whose
/// torque is not recorded (`current_<wheel>_a` becomes `torque_<wheel>_nm`).
void tell_torques(double motor_constant, DriveRecording& drive);

/// What a channel is called without its unit and what it stands for, `current` and `left_a`.
std::vector<const DriveChannel*> channels_of(const DriveRecording& drive, std::string_view prefix);

/// Those of any of the drives that begin so, each once.
std::vector<std::string> channel_names(const std::vector<DriveRecording>& drives,
                                       std::string_view prefix);

/// Whether any of the drives has such a channel.
bool any_has(const std::vector<DriveRecording>& drives, std::string_view prefix);

}  // namespace regoplan
