#include "drive_diagnosis/instruments/exchanged_rims.h"

#include <fmt/format.h>

#include <cmath>

#include "drive_diagnosis/instruments/sensor_checks.h"
#include "drive_diagnosis/recording/robust_statistics.h"

namespace regoplan {
namespace {

/// Of the yaw rate with how much faster the right wheel is told; 0 where that is not sure.
double turning_correlation(const std::vector<DriveRecording>& drives,
                           const std::vector<DriveWindow>& windows, const WheelPair& wheels) {
  std::vector<double> yaw_rate, faster;
  for (const DriveWindow& window : windows) {
    const auto rim_rad_s = [&](const std::string& wheel) {
      return channel_mean(drives[window.drive], window, "wheel_speed_" + wheel + "_rad_s");
    };
    const double right_more = rim_rad_s(wheels.second) - rim_rad_s(wheels.first);
    if (std::isnan(right_more) || std::isnan(window.yaw_rate_rad_s)) continue;
    yaw_rate.push_back(window.yaw_rate_rad_s);
    faster.push_back(right_more);
  }
  if (yaw_rate.size() < SensorChecks::kChecked) return 0;
  const double r = correlation(yaw_rate, faster);
  return is_sure(r, yaw_rate.size()) ? r : 0;
}

}  // namespace

std::vector<WheelPair> wheels_across(const Vehicle& vehicle) {
  std::vector<WheelPair> pairs;
  for (const WheelMount& left : vehicle.wheels) {
    if (!(left.y_m > 0)) continue;
    const WheelMount* nearest = nullptr;
    for (const WheelMount& right : vehicle.wheels) {
      if (!(right.y_m < 0)) continue;
      if (nearest == nullptr ||
          std::abs(right.x_m - left.x_m) < std::abs(nearest->x_m - left.x_m)) {
        nearest = &right;
      }
    }
    if (nearest != nullptr) pairs.emplace_back(left.name, nearest->name);
  }
  return pairs;
}

std::vector<ExchangedRims> exchanged_rims(const std::vector<DriveRecording>& drives,
                                          const std::vector<DriveWindow>& windows,
                                          const Vehicle& vehicle) {
  std::vector<ExchangedRims> exchanged;
  bool any_is_right = false;
  for (const WheelPair& wheels : wheels_across(vehicle)) {
    const double r = turning_correlation(drives, windows, wheels);
    if (r < 0) exchanged.push_back({.wheels = wheels, .correlation = r});
    any_is_right |= r > 0;
  }
  if (!any_is_right) exchanged.clear();
  return exchanged;
}

DriveFinding exchanged_finding(const ExchangedRims& exchanged) {
  const auto& [left, right] = exchanged.wheels;
  return {.id = "swapped_sides",
          .drive = "",
          .text = fmt::format("wheel speeds: {} runs slower than {} in left turns (correlation "
                              "{:.2f}), while other right wheels run faster: these two columns are "
                              "taken the other way round",
                              right, left, exchanged.correlation),
          .value = exchanged.correlation,
          .mended = true};
}

}  // namespace regoplan
