#include "drive_diagnosis/instruments/rim_unit.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "drive_diagnosis/instruments/column_factors.h"
#include "drive_diagnosis/instruments/sensor_checks.h"
#include "drive_diagnosis/recording/robust_statistics.h"

namespace regoplan {
namespace {

struct RimUnit {
  double per_rad_s;
  std::string_view words;
};

constexpr std::array<RimUnit, 2> kRimUnits{
    {{30 / std::numbers::pi, "turns a minute"}, {180 / std::numbers::pi, "degrees a second"}}};

/// By what a column is to be multiplied; nothing where too few windows move.
std::optional<double> factor_of(const DriveRecording& drive, std::size_t index,
                                const std::string& channel, const std::vector<DriveWindow>& windows,
                                double wheel_radius_m) {
  std::vector<double> rolls_rad_s, told;
  for (const DriveWindow& window : windows) {
    if (window.drive != index || !(window.speed_mps > kMoving_mps * window.pace)) continue;
    const double value = std::abs(channel_mean(drive, window, channel));
    if (std::isnan(value)) continue;
    rolls_rad_s.push_back(window.speed_mps / wheel_radius_m);
    told.push_back(value);
  }
  if (told.size() < SensorChecks::kChecked) return std::nullopt;
  const double ratio = robust_ratio(rolls_rad_s, told);
  constexpr double kSlip = 0.3;
  for (const RimUnit& unit : kRimUnits) {
    if (std::abs(std::log(ratio / unit.per_rad_s)) < kSlip) return 1 / unit.per_rad_s;
  }
  return 1;
}

DriveFinding unit_finding(const FactoredColumns& columns) {
  std::string_view words;
  for (const RimUnit& unit : kRimUnits) {
    if (columns.factor() == 1 / unit.per_rad_s) words = unit.words;
  }
  return {
      .id = "unit",
      .text = fmt::format("{}: beside the speed along the track they are {} in columns of rad/s: "
                          "taken so",
                          fmt::join(without_units(columns.channels), ", "), words),
      .value = 1 / columns.factor(),
      .mended = true};
}

}  // namespace

std::vector<DriveFinding> mend_rim_units(std::vector<DriveRecording>& drives,
                                         const std::vector<DriveWindow>& windows,
                                         double wheel_radius_m) {
  std::vector<FactoredColumns> groups;
  for (const std::string& name : channel_names(drives, "wheel_speed_")) {
    ColumnFactors factors(drives.size());
    for (std::size_t i = 0; i < drives.size(); ++i) {
      if (drives[i].channel(name) == nullptr) continue;
      factors[i] = factor_of(drives[i], i, name, windows, wheel_radius_m);
    }
    FactoredColumns::add(name, with_others_followed(factors), groups);
  }
  std::vector<DriveFinding> findings;
  for (const FactoredColumns& group : groups) {
    if (group.factor() == 1) continue;
    for (const std::string& name : group.channels) multiply_column(name, group.factors, drives);
    std::ranges::move(findings_of(group, unit_finding(group), drives),
                      std::back_inserter(findings));
  }
  return findings;
}

}  // namespace regoplan
