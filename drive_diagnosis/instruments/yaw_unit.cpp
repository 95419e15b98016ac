#include "drive_diagnosis/instruments/yaw_unit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "drive_diagnosis/recording/robust_statistics.h"
#include "terramech/basics/angles.h"

namespace regoplan {
namespace {

constexpr double kDegreesPerRadian = 1 / kDegree;

/// The value in a column of degrees, read as such, of the sample nearest to the window's middle: to
/// smooth radians in such a column is no good where they jump from pi to -pi.
double yaw_near_middle(const DriveRecording& drive, const DriveChannel& yaw,
                       const DriveWindow& window) {
  double nearest = kNotSampled, apart_s = window.duration_s() / 2;
  for (std::size_t i = 0; i < drive.size(); ++i) {
    const double off_s = std::abs(drive.time_s[i] - window.middle_s());
    if (std::isnan(yaw.values[i]) || off_s > apart_s) continue;
    apart_s = off_s;
    nearest = static_cast<double>(yaw.values[i]);
  }
  return nearest;
}

}  // namespace

bool yaw_is_in_radians(const DriveRecording& drive, std::size_t index,
                       const std::vector<DriveWindow>& windows) {
  constexpr std::size_t kFewest = 4;
  constexpr double kAlong_rad = 10 * kDegree, kOff_rad = 5 * kDegree, kFarther = 3;
  const DriveChannel* yaw = drive.channel("yaw_rad");
  if (yaw == nullptr) return false;
  // A little more: scatter.
  constexpr double kFullTurn_rad = 1.05 * 2 * std::numbers::pi * kDegree;
  const bool is_small = std::ranges::all_of(yaw->values, [](float value) {
    return std::isnan(value) || std::abs(static_cast<double>(value)) < kFullTurn_rad;
  });
  if (!is_small) return false;
  std::vector<double> as_told, as_radians;
  for (const DriveWindow& window : windows) {
    if (window.drive != index || !(window.speed_mps > kMoving_mps * window.pace)) continue;
    const double value = yaw_near_middle(drive, *yaw, window);
    if (std::isnan(value) || std::isnan(window.course_rad)) continue;
    const auto off_track = [&window](double yaw_rad) {
      return std::abs(std::remainder(window.course_rad - yaw_rad, std::numbers::pi));
    };
    as_told.push_back(off_track(value));
    as_radians.push_back(off_track(kDegreesPerRadian * value));
  }
  if (as_told.size() < kFewest) return false;
  const double told = median_value(std::move(as_told));
  const double radians = median_value(std::move(as_radians));
  return radians < kAlong_rad && told > kOff_rad && told > kFarther * radians;
}

std::vector<DriveFinding> mend_yaw_in_radians(std::vector<DriveRecording>& drives,
                                              const std::vector<DriveWindow>& windows) {
  std::vector<DriveFinding> findings;
  for (std::size_t i = 0; i < drives.size(); ++i) {
    if (!yaw_is_in_radians(drives[i], i, windows)) continue;
    for (float& value : drives[i].channel("yaw_rad")->values) {
      value = static_cast<float>(kDegreesPerRadian * static_cast<double>(value));
    }
    findings.push_back({.id = "unit",
                        .drive = drives[i].drive_id,
                        .text = "yaw looks along the track where it is taken for radians, in a "
                                "column of degrees: taken so",
                        .value = kDegreesPerRadian,
                        .unit = "deg/rad",
                        .mended = true});
  }
  return findings;
}

}  // namespace regoplan
