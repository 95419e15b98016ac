#include "drive_diagnosis/drive_windows.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "drive_diagnosis/robust_statistics.h"
#include "drive_diagnosis/time_checks.h"

namespace regoplan {
namespace {

struct Rows {
  std::size_t from = 0, to = 0;  ///< to is excluded
};

/// A polynomial through samples, about the middle of the window.
struct Smoothed {
  double value = kNotSampled, slope = kNotSampled, bend = 0;
  double slope_std = kNotSampled;
  /// Standard deviations by that of one sample.
  double value_by_sample = kNotSampled, slope_by_sample = kNotSampled;
  int count = 0;
  std::vector<double> time_s, slope_weights;  ///< the slope is the weights' sum over the samples

  double at(double t_s) const {
    return value + (std::isnan(slope) ? 0 : slope * t_s) + bend * t_s * t_s / 2;
  }
  /// How much of the slope is the mean slope from one time to another.
  double share(double from_s, double to_s) const {
    double sum = 0;
    for (std::size_t i = 0; i < slope_weights.size(); ++i) {
      sum += slope_weights[i] * std::clamp(time_s[i], from_s, to_s);
    }
    return sum;
  }
};

Smoothed smoothed(const std::vector<double>& time_s, const std::vector<double>& values) {
  Smoothed result{.count = static_cast<int>(values.size()), .time_s = time_s, .slope_weights = {}};
  if (values.empty()) return result;
  const auto n = static_cast<Eigen::Index>(values.size());
  const Eigen::Index degree = n >= 5 ? 2 : n >= 3 ? 1 : 0;
  Eigen::MatrixXd design(n, degree + 1);
  Eigen::VectorXd y(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double t = time_s[static_cast<std::size_t>(i)];
    for (Eigen::Index k = 0; k <= degree; ++k) design(i, k) = std::pow(t, static_cast<double>(k));
    y[i] = values[static_cast<std::size_t>(i)];
  }
  const Eigen::MatrixXd normal = design.transpose() * design;
  const Eigen::LDLT<Eigen::MatrixXd> solver(normal);
  const Eigen::VectorXd c = solver.solve(design.transpose() * y);
  result.value = c[0];
  if (degree >= 1) result.slope = c[1];
  if (degree >= 2) result.bend = 2 * c[2];
  const Eigen::MatrixXd weights = solver.solve(design.transpose());
  result.value_by_sample = weights.row(0).norm();
  if (degree >= 1) {
    result.slope_weights.assign(weights.row(1).begin(), weights.row(1).end());
    result.slope_by_sample = weights.row(1).norm();
  }
  if (degree >= 1 && n > degree + 1) {
    const double variance = (y - design * c).squaredNorm() / static_cast<double>(n - degree - 1);
    result.slope_std = std::sqrt(variance) * result.slope_by_sample;
  }
  return result;
}

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

/// Parts of the smoothed time, with their shares of the means.
void divide(double from_s, double to_s, DriveWindow& window) {
  const double part_s = (to_s - from_s) / DriveWindow::kParts;
  for (std::size_t j = 0; j < DriveWindow::kParts; ++j) {
    WindowPart& part = window.parts.at(j);
    part.start_s = from_s + static_cast<double>(j) * part_s;
    part.end_s = part.start_s + part_s;
    const double within_s =
        std::min(part.end_s, window.end_s) - std::max(part.start_s, window.start_s);
    part.mean_share = std::max(0.0, within_s) / window.duration_s();
  }
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
  const Smoothed x = smoothed(time_s, xs), y = smoothed(time_s, ys);
  window.x_m = x0 + x.value;
  window.y_m = y0 + y.value;
  window.speed_mps = std::hypot(x.slope, y.slope);
  window.course_rad = std::atan2(y.slope, x.slope);
  window.speed_std_mps = std::hypot(x.slope_std, y.slope_std) / std::numbers::sqrt2;
  window.velocity_by_fix_1ps = x.slope_by_sample;
  window.acceleration_mps2 =
      window.speed_mps > 0 ? (x.slope * x.bend + y.slope * y.bend) / window.speed_mps : 0;
  for (WindowPart& part : window.parts) {
    const double t_s = (part.start_s + part.end_s) / 2 - middle_s;
    part.x_m = x0 + x.at(t_s);
    part.y_m = y0 + y.at(t_s);
    part.track_share = x.share(part.start_s - middle_s, part.end_s - middle_s);
  }
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
  const Smoothed fit = smoothed(time_s, values);
  window.yaw_rad = fit.value;
  window.yaw_rate_rad_s = fit.slope;
  window.yaw_rate_std_rad_s = fit.slope_std;
  window.yaw_by_fix = fit.value_by_sample;
  window.yaw_rate_by_fix_1ps = fit.slope_by_sample;
  for (WindowPart& part : window.parts) {
    part.yaw_rad = fit.at((part.start_s + part.end_s) / 2 - middle_s);
    part.turn_share = fit.share(part.start_s - middle_s, part.end_s - middle_s);
  }
}

/// The turning rate of each wheel.
std::vector<Smoothed> wheel_rates(const DriveRecording& drive, const Rows& rows, double middle_s) {
  std::vector<Smoothed> rates;
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
double wheel_acceleration(const std::vector<Smoothed>& rates) {
  double sum = 0;
  for (const Smoothed& rate : rates) sum += rate.slope;
  return rates.empty() ? kNotSampled : sum / static_cast<double>(rates.size());
}

/// \param wide rows that position and heading are smoothed over
DriveWindow window_of(const DriveRecording& drive, std::size_t index, const Rows& rows,
                      const Rows& wide) {
  DriveWindow window{
      .drive = index, .start_s = drive.time_s[rows.from], .end_s = drive.time_s[rows.to - 1]};
  const double middle_s = (window.start_s + window.end_s) / 2;
  divide(drive.time_s[wide.from], drive.time_s[wide.to - 1], window);
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

std::vector<DriveWindow> drive_windows(const DriveRecording& drive, std::size_t index,
                                       double window_s, double beyond) {
  std::vector<DriveWindow> windows;
  const double gap_s = gap_max_s(drive);
  const std::size_t n = drive.size();
  for (std::size_t from = 0; from < n;) {
    std::size_t to = from + 1;
    while (to < n && drive.time_s[to] < drive.time_s[from] + window_s &&
           drive.time_s[to] - drive.time_s[to - 1] <= gap_s) {
      ++to;
    }
    constexpr double kLeastShare = 0.8;
    constexpr std::size_t kLeastRows = 5;
    if (to - from >= kLeastRows &&
        drive.time_s[to - 1] - drive.time_s[from] >= kLeastShare * window_s) {
      Rows wide{from, to};
      const double reach_s = beyond * window_s;
      while (wide.from > 0 && drive.time_s[from] - drive.time_s[wide.from - 1] <= reach_s &&
             drive.time_s[wide.from] - drive.time_s[wide.from - 1] <= gap_s) {
        --wide.from;
      }
      while (wide.to < n && drive.time_s[wide.to] - drive.time_s[to - 1] <= reach_s &&
             drive.time_s[wide.to] - drive.time_s[wide.to - 1] <= gap_s) {
        ++wide.to;
      }
      windows.push_back(window_of(drive, index, {from, to}, wide));
    }
    from = to;
  }
  return windows;
}

double channel_mean(const DriveRecording& drive, const DriveWindow& window,
                    std::string_view channel) {
  for (std::size_t i = 0; i < drive.channels.size(); ++i) {
    if (drive.channels[i].name == channel) return window.channels[i];
  }
  return kNotSampled;
}

}  // namespace regoplan
