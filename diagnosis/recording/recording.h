#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "terramech/mechanisms/mechanism.h"

namespace regoplan {

/// What a single-wheel test bed measures.
enum class Channel { kFx, kFy, kTorque, kSinkage, kRutLeft, kRutRight };

constexpr std::size_t kChannelCount = 6;

inline constexpr std::array<Channel, kChannelCount> kChannels{
    Channel::kFx,      Channel::kFy,      Channel::kTorque,
    Channel::kSinkage, Channel::kRutLeft, Channel::kRutRight};

/// A channel's column in files: `fx_n`, `fy_n`, `torque_nm`, `sinkage_m`, `rut_left_m`,
/// `rut_right_m`.
std::string_view name(Channel channel);

/// One steady run, or one sample of a run: the commanded conditions and what was measured.
struct WheelRun {
  std::string run_id;
  double load_n = 0;
  double slip_ratio = 0;       ///< eq. (1) of the paper, in [-1, 1]
  double slip_angle_rad = 0;   ///< in [-pi/2, pi/2]
  WheelConditions conditions;  ///< pass, speed, position, time, wheel angle, where recorded
  double day = 0;              ///< number, or days since 1970-01-01
  std::optional<int> replicate;
  std::string wheel;  ///< which wheel, where several were tested
  std::array<double, kChannelCount> measured{kNotMeasured, kNotMeasured, kNotMeasured,
                                             kNotMeasured, kNotMeasured, kNotMeasured};

  static constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();
  double value(Channel channel) const { return measured[static_cast<std::size_t>(channel)]; }
};

/// Conditions that a recording may or may not state.
struct RecordedColumns {
  bool day = false, pass = false, speed = false, position = false, time = false,
       wheel_angle = false, wheel = false;
};

/// A single-wheel recording, rows in the order of the runs.
struct Recording {
  std::vector<WheelRun> runs;
  RecordedColumns columns;
  std::vector<Channel> channels;      ///< measured at least once
  std::vector<std::string> ignored;   ///< columns that mean nothing here
  std::vector<std::string> warnings;  ///< of units, signs and doubtful values, a sentence each
};

}  // namespace regoplan
