#include "drive_diagnosis/recording/drive_windows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "drive_diagnosis/recording/drive_pace.h"
#include "drive_diagnosis/recording/robust_statistics.h"
#include "drive_diagnosis/recording/time_checks.h"

namespace regoplan {
namespace {

struct Rows {
  std::size_t from = 0, to = 0;  ///< to is excluded
};

double mean_of(const std::vector<float>& values, const Rows& rows) {
  double sum = 0;
  int count = 0;
  for (std::size_t i = rows.from; i < rows.to; ++i) {
    if (std::isnan(values[i])) continue;
    sum += static_cast<double>(values[i]);
    ++count;
  }
  return count > 0 ? sum / count : kNotSampled;
}

double mean_angle(const std::vector<float>& values, const Rows& rows) {
  double c = 0, s = 0;
  bool any = false;
  for (std::size_t i = rows.from; i < rows.to; ++i) {
    if (std::isnan(values[i])) continue;
    c += std::cos(static_cast<double>(values[i]));
    s += std::sin(static_cast<double>(values[i]));
    any = true;
  }
  return any ? std::atan2(s, c) : kNotSampled;
}

double range_of(const std::vector<float>& values, const Rows& rows) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = rows.from; i < rows.to; ++i) {
    if (std::isnan(values[i])) continue;
    low = std::min(low, static_cast<double>(values[i]));
    high = std::max(high, static_cast<double>(values[i]));
  }
  return high >= low ? high - low : 0;
}

void smooth_track(const DriveRecording& drive, const Rows& rows, double middle_s,
                  DriveWindow& window) {
  std::vector<double> time_s, xs, ys;
  for (std::size_t i = rows.from; i < rows.to; ++i) {
    if (std::isnan(drive.x_m[i])) continue;
    time_s.push_back(drive.time_s[i] - middle_s);
    xs.push_back(drive.x_m[i]);
    ys.push_back(drive.y_m[i]);
  }
  window.fixes = static_cast<int>(xs.size());
  const double x0 = xs.empty() ? kNotSampled : xs.front(),
               y0 = ys.empty() ? kNotSampled : ys.front();
  for (double& x : xs) x -= x0;
  for (double& y : ys) y -= y0;
  window.track = {.x0_m = x0, .y0_m = y0, .x = smoothed(time_s, xs), .y = smoothed(time_s, ys)};
  const auto& [x0_m, y0_m, x, y] = window.track;
  window.x_m = x0 + x.value;
  window.y_m = y0 + y.value;
  window.speed_mps = std::hypot(x.slope, y.slope);
  window.course_rad = std::atan2(y.slope, x.slope);
  window.speed_std_mps = std::hypot(x.slope_std, y.slope_std) / std::numbers::sqrt2;
  window.velocity_by_fix_1ps = x.slope_by_sample;
  window.acceleration_mps2 =
      window.speed_mps > 0 ? (x.slope * x.bend + y.slope * y.bend) / window.speed_mps : 0;
  const double c = std::cos(window.yaw_rad), s = std::sin(window.yaw_rad);
  window.forward_mps = c * x.slope + s * y.slope;
  window.left_mps = c * y.slope - s * x.slope;
}

void smooth_yaw(const DriveRecording& drive, const Rows& rows, double middle_s,
                DriveWindow& window) {
  const DriveChannel* yaw = drive.channel("yaw_rad");
  window.yaw_rad = window.yaw_rate_rad_s = window.yaw_rate_std_rad_s = kNotSampled;
  if (!yaw) return;
  std::vector<double> time_s, values;
  for (std::size_t i = rows.from; i < rows.to; ++i) {
    if (std::isnan(yaw->values[i])) continue;
    double value = static_cast<double>(yaw->values[i]);
    if (!values.empty()) {
      value = values.back() + std::remainder(value - values.back(), 2 * std::numbers::pi);
    }
    time_s.push_back(drive.time_s[i] - middle_s);
    values.push_back(value);
  }
  window.yaw = smoothed(time_s, values);
  const SampleSmoothing& fit = window.yaw;
  window.yaw_rad = fit.value;
  window.yaw_rate_rad_s = fit.slope;
  window.yaw_rate_std_rad_s = fit.slope_std;
  window.yaw_by_fix = fit.value_by_sample;
  window.yaw_rate_by_fix_1ps = fit.slope_by_sample;
}

/// The turning rate of each wheel.
std::vector<SampleSmoothing> wheel_rates(const DriveRecording& drive, const Rows& rows,
                                         double middle_s) {
  std::vector<SampleSmoothing> rates;
  for (const DriveChannel* wheel : channels_of(drive, "wheel_speed_")) {
    std::vector<double> time_s, values;
    for (std::size_t i = rows.from; i < rows.to; ++i) {
      if (std::isnan(wheel->values[i])) continue;
      time_s.push_back(drive.time_s[i] - middle_s);
      values.push_back(static_cast<double>(wheel->values[i]));
    }
    constexpr std::size_t kLeast = 5;
    if (values.size() >= kLeast) rates.push_back(smoothed(time_s, values));
  }
  return rates;
}

/// Wheel speeds come often and without the scatter of fixes: their slope is the best acceleration.
double wheel_acceleration(const std::vector<SampleSmoothing>& rates) {
  double sum = 0;
  for (const SampleSmoothing& rate : rates) sum += rate.slope;
  return rates.empty() ? kNotSampled : sum / static_cast<double>(rates.size());
}

/// \param wide rows that position and heading are smoothed over
DriveWindow window_of(const DriveRecording& drive, std::size_t index, const Rows& rows,
                      const Rows& wide) {
  DriveWindow window{.drive = index,
                     .start_s = drive.time_s[rows.from],
                     .end_s = drive.time_s[rows.to - 1],
                     .smoothed_from_s = drive.time_s[wide.from],
                     .smoothed_to_s = drive.time_s[wide.to - 1]};
  const double middle_s = window.middle_s();
  smooth_yaw(drive, wide, middle_s, window);
  smooth_track(drive, wide, middle_s, window);
  window.wheel_acceleration_rad_s2 = wheel_acceleration(wheel_rates(drive, rows, middle_s));
  window.pitch_rad = window.roll_rad = window.sensed_speed_mps = kNotSampled;
  window.steady = true;
  for (const DriveChannel& channel : drive.channels) {
    const bool turns = channel.name == "yaw_rad" || channel.name == "course_rad";
    const double mean = turns ? mean_angle(channel.values, rows) : mean_of(channel.values, rows);
    window.channels.push_back(mean);
    if (channel.name == "pitch_rad") window.pitch_rad = mean;
    if (channel.name == "roll_rad") window.roll_rad = mean;
    if (channel.name == "speed_mps") window.sensed_speed_mps = mean;
    if (channel.name == "command_speed") window.steady = range_of(channel.values, rows) == 0;
  }
  return window;
}

}  // namespace

MapPlace DriveWindow::place_at(double off_s) const {
  const MapPlace smoothed = track.at(off_s);
  if (std::isfinite(smoothed.x_m + smoothed.y_m)) return smoothed;
  const double way_m = speed_mps * off_s;
  return {x_m + way_m * std::cos(course_rad), y_m + way_m * std::sin(course_rad)};
}

std::vector<WindowPart> DriveWindow::divided(std::size_t count) const {
  const double part_s = (smoothed_to_s - smoothed_from_s) / static_cast<double>(count);
  std::vector<WindowPart> parts(count);
  for (std::size_t j = 0; j < count; ++j) {
    WindowPart& part = parts[j];
    part.start_s = smoothed_from_s + static_cast<double>(j) * part_s;
    part.end_s = part.start_s + part_s;
    const double within_s = std::min(part.end_s, end_s) - std::max(part.start_s, start_s);
    part.mean_share = std::max(0.0, within_s) / duration_s();
    const double from_s = part.start_s - middle_s(), to_s = part.end_s - middle_s();
    const double t_s = (from_s + to_s) / 2;
    const MapPlace place = track.at(t_s);
    part.x_m = place.x_m;
    part.y_m = place.y_m;
    part.track_share = track.x.share(from_s, to_s);
    // A parabola does not follow a turn that begins or ends within the window: of a track that
    // bends by 2 rad in 10 s, speeds were .04 m/s off (DriveWindows.ATurnThatEndsWithinIsFollowed).
    part.yaw_rad = yaw.at(t_s) + yaw.left_in(from_s, to_s);
    part.turn_share = yaw.share(from_s, to_s);
  }
  return parts;
}

std::vector<DriveWindow> drive_windows(const DriveRecording& drive, std::size_t index,
                                       double window_s, double beyond) {
  std::vector<DriveWindow> windows;
  const double gap_s = gap_max_s(drive), pace = pace_of(drive);
  // Windows are often a whole number of steps long: which rows they have must not hang on rounding.
  const double slack_s = clock_slack_s(drive);
  const std::size_t n = drive.size();
  for (std::size_t from = 0; from < n;) {
    std::size_t to = from + 1;
    while (to < n && drive.time_s[to] - drive.time_s[from] < window_s - slack_s &&
           drive.time_s[to] - drive.time_s[to - 1] <= gap_s) {
      ++to;
    }
    constexpr double kLeastShare = 0.8;
    constexpr std::size_t kLeastRows = 5;
    if (to - from >= kLeastRows &&
        drive.time_s[to - 1] - drive.time_s[from] >= kLeastShare * window_s - slack_s) {
      Rows wide{from, to};
      const double reach_s = beyond * window_s + slack_s;
      while (wide.from > 0 && drive.time_s[from] - drive.time_s[wide.from - 1] <= reach_s &&
             drive.time_s[wide.from] - drive.time_s[wide.from - 1] <= gap_s) {
        --wide.from;
      }
      while (wide.to < n && drive.time_s[wide.to] - drive.time_s[to - 1] <= reach_s &&
             drive.time_s[wide.to] - drive.time_s[wide.to - 1] <= gap_s) {
        ++wide.to;
      }
      windows.push_back(window_of(drive, index, {from, to}, wide));
      windows.back().pace = pace;
    }
    from = to;
  }
  return windows;
}

double channel_mean(const DriveRecording& drive, const DriveWindow& window,
                    std::string_view channel) {
  for (std::size_t i = 0; i < drive.channels.size(); ++i) {
    if (drive.channels[i].name == channel) return window.channels.at(i);
  }
  return kNotSampled;
}

}  // namespace regoplan
