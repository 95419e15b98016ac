#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/settings/settings_node.h"
#include "terramech/basics/value_range.h"

namespace regoplan {

/// A column of drive.csv that this program knows, and how it is held.
struct KnownDriveColumn {
  std::string channel;  ///< the name in SI and radians
  double per_unit = 1;  ///< SI value of one unit of the column
  ValueRange allowed;
};

/// `time_s, x_m, y_m, yaw_deg, roll_deg, pitch_deg, wheel_speed_<wheel or side>_rad_s` or `_rpm`,
/// `steer_<wheel>_deg, curvature_1pm, torque_<wheel>_nm, current_<wheel or side>_a,
/// sinkage_<wheel>_m, speed_mps` (over ground), `course_deg, command_speed, command_turn, pass`.
/// Nothing for any other name.
std::optional<KnownDriveColumn> known_drive_column(std::string_view name);

/// Where a column of a drive comes from in somebody else's log.
struct DriveColumnSource {
  std::string name;    ///< as `known_drive_column` knows it
  std::string column;  ///< in the log
  double scale = 1;    ///< value = scale * cell + offset
  double offset = 0;
  std::optional<std::string> fresh;  ///< a column that is 0 where the value only repeats
};

/// How the columns of a log are to be read.
struct DriveColumnMap {
  std::vector<DriveColumnSource> sources;
  /// Columns w, x, y, z of the body's attitude, body to map.
  std::optional<std::array<std::string, 4>> quaternion;
};

/// Reads
///
///     columns:
///       x_m: pos_x                                        # a column as it is
///       pitch_deg: {column: imu_pitch_deg, scale: -1, offset: 0, fresh: imu_fresh}
///     attitude_quaternion: {w: quat_w, x: quat_x, y: quat_y, z: quat_z}
///
/// Columns that the map does not name and that are known as they are need no entry.
DriveColumnMap read_drive_columns(const SettingsNode& node);
DriveColumnMap read_drive_columns_file(const std::string& file);

}  // namespace regoplan
