#include "drive_diagnosis/instruments/rim_sign.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "drive_diagnosis/instruments/column_factors.h"
#include "drive_diagnosis/recording/robust_statistics.h"
#include "terramech/basics/angles.h"

namespace regoplan {
namespace {

constexpr std::string_view kRims = "wheel_speed_";
constexpr double kMostly = 0.95;  ///< share of windows; what is short of it says nothing

/// The windows of a drive that move.
std::vector<const DriveWindow*> moving(std::size_t drive, const std::vector<DriveWindow>& windows) {
  std::vector<const DriveWindow*> result;
  for (const DriveWindow& window : windows) {
    if (window.drive == drive && window.speed_mps > kMoving_mps * window.pace) {
      result.push_back(&window);
    }
  }
  return result;
}

/// Whether a yaw looks along the track or back along it, so that `forward_mps` has a sign.
bool looks_along(const std::vector<const DriveWindow*>& windows) {
  constexpr double kAlong_rad = 30 * kDegree;
  std::vector<double> off;
  for (const DriveWindow* window : windows) {
    const double angle = std::remainder(window->course_rad - window->yaw_rad, std::numbers::pi);
    if (!std::isnan(angle)) off.push_back(std::abs(angle));
  }
  return off.size() >= SensorChecks::kChecked && median_value(std::move(off)) < kAlong_rad;
}

/// Of values beside the way that the vehicle goes: 1 with it, -1 against it, 0 undecided.
template <class Value>
int side_of(const std::vector<const DriveWindow*>& windows, const Value& value) {
  // In tighter turns one side of a large vehicle may roll backwards.
  constexpr double kTightest_1pm = 1.0 / 3;
  std::size_t all = 0, with = 0;
  for (const DriveWindow* window : windows) {
    const double product = value(*window) * window->forward_mps;
    if (std::isnan(product) || product == 0) continue;
    if (!(std::abs(window->yaw_rate_rad_s) < kTightest_1pm * std::abs(window->forward_mps))) {
      continue;
    }
    ++all;
    with += product > 0;
  }
  if (all < SensorChecks::kChecked) return 0;
  const double share = static_cast<double>(with) / static_cast<double>(all);
  return share >= kMostly ? 1 : share <= 1 - kMostly ? -1 : 0;
}

/// Whether the right side runs faster in left turns with these wheels turned round.
bool turns_rightly(const DriveRecording& drive, const std::set<std::string>& reversed,
                   const std::vector<const DriveWindow*>& windows, const SideGeometry& sides) {
  std::vector<double> turn, excess;
  for (const DriveWindow* told : windows) {
    DriveWindow window = *told;
    for (std::size_t k = 0; k < drive.channels.size(); ++k) {
      if (reversed.contains(drive.channels[k].name)) window.channels[k] *= -1;
    }
    const double more =
        side_mean(drive, window, "wheel_speed", "rad_s", sides.right_wheels, "right") -
        side_mean(drive, window, "wheel_speed", "rad_s", sides.left_wheels, "left");
    if (std::isnan(more + window.yaw_rate_rad_s)) continue;
    turn.push_back(window.yaw_rate_rad_s);
    excess.push_back(more);
  }
  const double r = correlation(turn, excess);
  return r > 0 && is_sure(r, turn.size());
}

/// Channels of a drive that are told with the other sign; nothing where it is too short to say.
std::optional<std::set<std::string>> reversed_rims(const DriveRecording& drive, std::size_t index,
                                                   const std::vector<DriveWindow>& all,
                                                   const SideGeometry& sides) {
  const std::vector<const DriveWindow*> windows = moving(index, all);
  if (windows.size() < SensorChecks::kChecked) return std::nullopt;
  if (!looks_along(windows)) return std::set<std::string>{};
  std::set<std::string> reversed;
  std::size_t rims = 0;
  for (const DriveChannel* channel : channels_of(drive, kRims)) {
    ++rims;
    const auto value = [&](const DriveWindow& window) {
      return channel_mean(drive, window, channel->name);
    };
    if (side_of(windows, value) < 0) reversed.insert(channel->name);
  }
  if (2 * reversed.size() < rims) return reversed;
  const int commanded = side_of(windows, [&](const DriveWindow& window) {
    return channel_mean(drive, window, "command_speed");
  });
  const bool is_forward =
      commanded != 0 ? commanded > 0 : turns_rightly(drive, reversed, windows, sides);
  if (!is_forward) reversed.clear();
  return reversed;
}

DriveFinding rim_finding(const FactoredColumns& columns) {
  return {
      .id = "sign",
      .text = fmt::format("{}: told to roll backwards while the vehicle drives the way that its "
                          "yaw looks: taken with the other sign",
                          fmt::join(without_units(columns.channels), ", ")),
      .mended = true};
}

}  // namespace

std::vector<DriveFinding> mend_rim_signs(std::vector<DriveRecording>& drives,
                                         const std::vector<DriveWindow>& windows,
                                         const SideGeometry& sides) {
  std::vector<std::optional<std::set<std::string>>> reversed;
  for (std::size_t i = 0; i < drives.size(); ++i) {
    reversed.push_back(reversed_rims(drives[i], i, windows, sides));
  }
  std::vector<FactoredColumns> groups;
  for (const std::string& name : channel_names(drives, kRims)) {
    ColumnFactors factors(drives.size());
    for (std::size_t i = 0; i < drives.size(); ++i) {
      if (!reversed[i] || drives[i].channel(name) == nullptr) continue;
      factors[i] = reversed[i]->contains(name) ? -1 : 1;
    }
    FactoredColumns::add(name, with_others_followed(factors), groups);
  }
  std::vector<DriveFinding> findings;
  for (const FactoredColumns& group : groups) {
    if (group.factor() == 1) continue;
    for (const std::string& name : group.channels) multiply_column(name, group.factors, drives);
    std::ranges::move(findings_of(group, rim_finding(group), drives), std::back_inserter(findings));
  }
  return findings;
}

}  // namespace regoplan
