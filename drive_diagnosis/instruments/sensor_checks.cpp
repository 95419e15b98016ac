#include "drive_diagnosis/instruments/sensor_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "drive_diagnosis/recording/robust_statistics.h"
#include "terramech/basics/angles.h"

namespace regoplan {
namespace {

/// Whether a window drives backwards, as far as commands or wheels say.
bool drives_back(const DriveRecording& drive, const DriveWindow& window) {
  const double command = channel_mean(drive, window, "command_speed");
  if (command != 0 && !std::isnan(command)) return command < 0;
  double sum = 0;
  for (std::size_t i = 0; i < drive.channels.size(); ++i) {
    const bool wheel = drive.channels[i].name.starts_with("wheel_speed_");
    if (wheel && !std::isnan(window.channels[i])) sum += window.channels[i];
  }
  return sum < 0;
}

bool moves(const DriveWindow& window) {
  return window.speed_mps > kMoving_mps * window.pace;
}

/// Quantities of windows, in pairs.
struct Pairs {
  std::vector<double> a, b;
  void add(double first, double second) {
    if (std::isnan(first) || std::isnan(second)) return;
    a.push_back(first);
    b.push_back(second);
  }
  double r() const { return correlation(a, b); }
  bool sure() const { return is_sure(r(), a.size()); }
};

struct KnownRatio {
  double ratio;
  std::string_view words;
};

/// What a ratio of two readings of one quantity most likely means.
std::string_view words_for(double ratio, std::span<const KnownRatio> known) {
  for (const KnownRatio& candidate : known) {
    if (std::abs(ratio / candidate.ratio - 1) < 0.06) return candidate.words;
  }
  return "an unknown unit";
}

class Checker {
 public:
  Checker(const std::vector<DriveRecording>& drives, const std::vector<DriveWindow>& windows,
          const SideGeometry& sides)
      : drives_(drives), windows_(windows), sides_(sides) {}

  SensorChecks check() {
    check_yaw();
    check_sensed_speed();
    check_wheel_sides();
    check_current_sides();
    return std::move(checks_);
  }

 private:
  void tell(std::string id, std::string text, double value, std::string unit, bool mended) {
    checks_.findings.push_back({.id = std::move(id),
                                .drive = "",
                                .text = std::move(text),
                                .value = value,
                                .unit = std::move(unit),
                                .mended = mended});
  }
  void check_yaw();
  void find_yaw_offset();
  void check_sensed_speed();
  void check_wheel_sides();
  void check_current_sides();
  double side(const DriveWindow& window, std::string_view quantity, std::string_view unit,
              bool left) const {
    return side_mean(drives_[window.drive], window, quantity, unit,
                     left ? sides_.left_wheels : sides_.right_wheels, left ? "left" : "right");
  }

  const std::vector<DriveRecording>& drives_;
  const std::vector<DriveWindow>& windows_;
  const SideGeometry& sides_;
  SensorChecks checks_;
};

void Checker::check_yaw() {
  Pairs turns;
  for (std::size_t i = 1; i < windows_.size(); ++i) {
    const DriveWindow &a = windows_[i - 1], &b = windows_[i];
    if (a.drive != b.drive || b.start_s - a.end_s > std::max(2.0, 0.4 * a.duration_s())) continue;
    if (!moves(a) || !moves(b)) continue;
    if (drives_back(drives_[a.drive], a) != drives_back(drives_[b.drive], b)) continue;
    const double course = std::remainder(b.course_rad - a.course_rad, 2 * std::numbers::pi);
    const double yaw = b.yaw_rad - a.yaw_rad;
    if (std::abs(course) > 1.5) continue;
    turns.add(course, std::remainder(yaw, 2 * std::numbers::pi));
  }
  if (!turns.sure()) return;
  if (turns.r() < 0) {
    checks_.yaw_sign = -1;
    tell("sign", "yaw turns the other way than the track (a compass?): taken with the other sign",
         turns.r(), "", true);
  }
  const double ratio = std::abs(robust_ratio(turns.a, turns.b));
  if (ratio < 1.0 / 20) {
    tell("unit", "yaw turns 57 times less than the track: radians in a column of degrees?", ratio,
         "", false);
  }
  find_yaw_offset();
}

void Checker::find_yaw_offset() {
  constexpr double kTurns_rad_s = 0.1;
  double c = 0, s = 0;
  std::vector<double> angles;
  for (const DriveWindow& window : windows_) {
    if (!moves(window) || window.speed_mps < 5 * window.speed_std_mps) continue;
    if (std::isnan(window.yaw_rad) ||
        std::abs(window.yaw_rate_rad_s) > kTurns_rad_s * window.pace) {
      continue;
    }
    const bool back = drives_back(drives_[window.drive], window);
    const double angle =
        window.course_rad + (back ? std::numbers::pi : 0.0) - checks_.yaw_sign * window.yaw_rad;
    angles.push_back(angle);
    c += std::cos(angle);
    s += std::sin(angle);
  }
  if (angles.size() < SensorChecks::kChecked) return;
  const double mean = std::atan2(s, c);
  std::vector<double> off;
  for (const double angle : angles) {
    off.push_back(std::abs(std::remainder(angle - mean, 2 * std::numbers::pi)));
  }
  const double spread = median_value(std::move(off)) / 0.6745;
  constexpr double kUseless_rad = 15 * kDegree;
  if (spread > kUseless_rad) {
    tell("yaw_unreliable",
         fmt::format("yaw and track differ by {:.0f} deg from window to window: nothing is said on "
                     "drift, and yaw is used for its rate only",
                     spread / kDegree),
         spread / kDegree, "deg", false);
  }
  // Slopes take a vehicle aside by a few degrees, now to this side and now to that.
  constexpr double kAside_rad = 5 * kDegree, kSure = 5;
  const double err_rad = spread / std::sqrt(static_cast<double>(angles.size()));
  if (std::abs(mean) > std::max(kAside_rad, kSure * err_rad) || checks_.yaw_sign < 0) {
    checks_.yaw_offset_rad = mean;
    tell("yaw_offset",
         fmt::format("yaw looks {:.0f} deg away from the track: taken off", mean / kDegree),
         mean / kDegree, "deg", true);
  }
}

void Checker::check_sensed_speed() {
  Pairs speeds;
  for (const DriveWindow& window : windows_) {
    if (moves(window) && window.fixes >= 5) {
      speeds.add(window.speed_mps, std::abs(window.sensed_speed_mps));
    }
  }
  if (speeds.a.size() < SensorChecks::kChecked) return;
  const double ratio = robust_ratio(speeds.a, speeds.b);
  if (std::abs(ratio - 1) < 0.12) return;
  constexpr std::array<KnownRatio, 5> kUnits{{{1.9438, "knots"},
                                              {3.6, "km/h"},
                                              {2.2369, "mph"},
                                              {0.5144, "converted from knots though it was m/s"},
                                              {3.2808, "ft/s"}}};
  checks_.sensed_speed_per_mps = ratio;
  tell("unit",
       fmt::format("speed_mps is {:.2f} times the speed of the positions: {}; divided by it", ratio,
                   words_for(ratio, kUnits)),
       ratio, "", true);
}

void Checker::check_wheel_sides() {
  Pairs turning, speed;
  for (const DriveWindow& window : windows_) {
    const double left = side(window, "wheel_speed", "rad_s", true);
    const double right = side(window, "wheel_speed", "rad_s", false);
    turning.add(checks_.yaw_sign * window.yaw_rate_rad_s, right - left);
    const bool back = drives_back(drives_[window.drive], window);
    if (moves(window)) speed.add(back ? -window.speed_mps : window.speed_mps, (left + right) / 2);
  }
  if (turning.sure() && turning.r() < 0) {
    checks_.wheel_sides_swapped = true;
    tell("swapped_sides",
         fmt::format("wheel speeds: the right side runs slower in left turns (correlation {:.2f}): "
                     "the columns left and right are taken the other way round",
                     turning.r()),
         turning.r(), "", true);
  }
  if (speed.a.size() >= SensorChecks::kChecked) {
    const double per_speed = robust_ratio(speed.a, speed.b);
    if (per_speed < 0) {
      tell("sign", "the wheels turn backwards while the vehicle drives forwards", per_speed, "1/m",
           false);
    } else if (per_speed > 30) {
      tell("unit",
           fmt::format("the wheels turn by {:.0f} rad a metre: rpm or deg/s in a column of rad/s?",
                       per_speed),
           per_speed, "rad/m", false);
    }
  }
}

void Checker::check_current_sides() {
  Pairs turning;
  for (const DriveWindow& window : windows_) {
    if (!channels_of(drives_[window.drive], "steer_").empty()) return;  // skid steering only
    if (drives_back(drives_[window.drive], window) || !moves(window)) continue;
    turning.add(checks_.yaw_sign * window.yaw_rate_rad_s,
                side(window, "current", "a", false) - side(window, "current", "a", true));
  }
  if (!turning.sure() || turning.r() > 0) return;
  checks_.current_sides_swapped = true;
  tell("swapped_sides",
       fmt::format("currents: the left side takes more in left turns (correlation {:.2f}): the "
                   "columns left and right are taken the other way round",
                   turning.r()),
       turning.r(), "", true);
}

}  // namespace

bool is_sure(double r, std::size_t n) {
  constexpr double kOnceInAMillion = 4.9, kWeak = 0.4;
  if (n < SensorChecks::kChecked || !(std::abs(r) > kWeak)) return false;
  // Fisher: of pairs without relation it is normal, with a standard deviation of 1 / sqrt(n - 3).
  return std::atanh(std::min(std::abs(r), 1.0)) * std::sqrt(static_cast<double>(n) - 3) >
         kOnceInAMillion;
}

double side_mean(const DriveRecording& drive, const DriveWindow& window, std::string_view quantity,
                 std::string_view unit, const std::vector<std::string>& wheels,
                 std::string_view side) {
  const double whole = channel_mean(drive, window, fmt::format("{}_{}_{}", quantity, side, unit));
  if (!std::isnan(whole)) return whole;
  double sum = 0;
  int count = 0;
  for (const std::string& wheel : wheels) {
    const double value =
        channel_mean(drive, window, fmt::format("{}_{}_{}", quantity, wheel, unit));
    if (std::isnan(value)) continue;
    sum += value;
    ++count;
  }
  return count > 0 ? sum / count : kNotSampled;
}

SensorChecks check_sensors(const std::vector<DriveRecording>& drives,
                           const std::vector<DriveWindow>& windows, const SideGeometry& sides) {
  return Checker(drives, windows, sides).check();
}

}  // namespace regoplan
