#include "drive_diagnosis/instruments/track_unit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "drive_diagnosis/recording/robust_statistics.h"
#include "drive_diagnosis/recording/time_checks.h"

namespace regoplan {
namespace {

/// What is driven from row to row, as rims or the sensor of speed say.
struct ToldSpeed {
  bool by_rims = false;
  std::vector<double> signed_mps, size_mps;  ///< of the mean wheel; of each, in the mean
};

/// The value of a channel, or the last one before: wheel speeds may come less often than rows.
std::vector<double> held(const std::vector<float>& values) {
  std::vector<double> result;
  double last = 0;
  for (const float value : values) {
    if (!std::isnan(value)) last = static_cast<double>(value);
    result.push_back(last);
  }
  return result;
}

std::optional<ToldSpeed> told_speed(const DriveRecording& drive, const Vehicle* vehicle) {
  const auto wheels = channels_of(drive, "wheel_speed_");
  if (vehicle != nullptr && !wheels.empty()) {
    ToldSpeed told{.by_rims = true,
                   .signed_mps = std::vector<double>(drive.size()),
                   .size_mps = std::vector<double>(drive.size())};
    const double each_m = vehicle->wheel.radius_m / static_cast<double>(wheels.size());
    for (const DriveChannel* wheel : wheels) {
      const std::vector<double> rates = held(wheel->values);
      for (std::size_t i = 0; i < rates.size(); ++i) {
        told.signed_mps[i] += each_m * rates[i];
        told.size_mps[i] += each_m * std::abs(rates[i]);
      }
    }
    return told;
  }
  const DriveChannel* sensed = drive.channel("speed_mps");
  if (sensed == nullptr) return std::nullopt;
  ToldSpeed told{.signed_mps = held(sensed->values), .size_mps = {}};
  for (const double speed_mps : told.signed_mps) told.size_mps.push_back(std::abs(speed_mps));
  return told;
}

/// Rows whose position is new.
std::vector<std::size_t> fresh_fixes(const DriveRecording& drive) {
  std::vector<std::size_t> fresh;
  for (std::size_t i = 0; i < drive.size(); ++i) {
    if (std::isnan(drive.x_m[i]) || std::isnan(drive.y_m[i])) continue;
    const bool repeats = !fresh.empty() && drive.x_m[i] == drive.x_m[fresh.back()] &&
                         drive.y_m[i] == drive.y_m[fresh.back()];
    if (!repeats) fresh.push_back(i);
  }
  return fresh;
}

double scatter_m(const DriveRecording& drive, const std::vector<std::size_t>& fixes) {
  std::vector<double> time_s, xs, ys;
  for (const std::size_t i : fixes) {
    time_s.push_back(drive.time_s[i]);
    xs.push_back(drive.x_m[i]);
    ys.push_back(drive.y_m[i]);
  }
  return std::max(scatter_of_samples(time_s, xs), scatter_of_samples(time_s, ys));
}

/// How far positions go on each stretch, as a share of what is said to be driven.
struct Stretches {
  std::vector<double> shares;
  double way_m = 0;      ///< median of the positions'
  double scatter_m = 0;  ///< of a fix
};

Stretches stretches_of(const DriveRecording& drive, const ToldSpeed& told) {
  constexpr std::size_t kStretches = 24;  // few enough that bends within one are the exception
  constexpr double kTurnsRound = 0.5;     // wheels that turn against each other drive nowhere
  Stretches stretches;
  const std::vector<std::size_t> fixes = fresh_fixes(drive);
  const std::size_t each = std::max<std::size_t>(1, fixes.size() / kStretches);
  std::vector<double> ways_m;
  for (std::size_t k = 0; k + each < fixes.size(); k += each) {
    const std::size_t from = fixes[k], to = fixes[k + each];
    double driven_m = 0, rolled_m = 0;
    for (std::size_t i = from; i < to; ++i) {
      const double step_s = drive.time_s[i + 1] - drive.time_s[i];
      driven_m += told.signed_mps[i] * step_s;
      rolled_m += told.size_mps[i] * step_s;
    }
    if (!(std::abs(driven_m) > kTurnsRound * rolled_m)) continue;
    ways_m.push_back(std::hypot(drive.x_m[to] - drive.x_m[from], drive.y_m[to] - drive.y_m[from]));
    stretches.shares.push_back(ways_m.back() / std::abs(driven_m));
  }
  if (ways_m.empty()) return stretches;
  stretches.way_m = median_value(std::move(ways_m));
  stretches.scatter_m = scatter_m(drive, fixes);
  return stretches;
}

struct UnitOfTrack {
  double share;  ///< of what was driven, that positions in the column of m and s then go
  std::string_view words;
};

constexpr std::array<UnitOfTrack, 3> kLess{
    {{1e-3, "time in ms in a column of s, or positions in km in a column of m"},
     {1e-6, "time in microseconds in a column of s"},
     {1e-9, "time in nanoseconds in a column of s"}}};
constexpr std::array<UnitOfTrack, 4> kMore{{{3.2808, "positions in feet in a column of m"},
                                            {60, "time in minutes in a column of s"},
                                            {100, "positions in cm in a column of m"},
                                            {1000, "positions in mm in a column of m"}}};

/// The unit with which so much is gone, slip and bends allowed for.
std::optional<std::string_view> words_for(double share, std::span<const UnitOfTrack> units) {
  constexpr double kSlipsMost = 0.6, kRadiusErrs = 1.15;
  for (const UnitOfTrack& unit : units) {
    const double of_unit = share / unit.share;
    if (of_unit > 1 - kSlipsMost && of_unit < kRadiusErrs) return unit.words;
  }
  return std::nullopt;
}

}  // namespace

std::optional<DriveFinding> doubtful_track_unit(const DriveRecording& drive,
                                                const Vehicle* vehicle) {
  constexpr std::size_t kFewest = 8;
  constexpr double kMost = 2.5, kAlike = 2, kScatters = 5;
  const std::optional<ToldSpeed> told = told_speed(drive, vehicle);
  if (!told) return std::nullopt;
  const Stretches stretches = stretches_of(drive, *told);
  if (stretches.shares.size() < kFewest || stretches.way_m < kScatters * stretches.scatter_m) {
    return std::nullopt;
  }
  const double share = median_value(stretches.shares);
  const bool is_alike = quantile_value(stretches.shares, 0.8) < kAlike * share &&
                        quantile_value(stretches.shares, 0.2) * kAlike > share;
  if (!is_alike) return std::nullopt;
  const auto known = words_for(share, share < 1 ? std::span<const UnitOfTrack>(kLess) : kMore);
  const bool is_doubtful = share < 1 ? known.has_value() : share > kMost;
  if (!is_doubtful) return std::nullopt;
  std::string words(
      known.value_or("time, positions or speeds in another unit than their columns say"));
  if (share > 1 && told->by_rims) words += ", or wheels of another radius than the vehicle's";
  return DriveFinding{
      .id = "unit",
      .drive = drive.drive_id,
      .text = fmt::format(
          "positions go {:.2g} m for each metre that {}, rows are {:.3g} s apart: {}? The drive is "
          "left out",
          share, told->by_rims ? "rims roll" : "speed_mps says", median_step_s(drive), words),
      .value = share};
}

void leave_samples_out(DriveRecording& drive) {
  drive.time_s.clear();
  drive.x_m.clear();
  drive.y_m.clear();
  for (DriveChannel& channel : drive.channels) channel.values.clear();
}

}  // namespace regoplan
