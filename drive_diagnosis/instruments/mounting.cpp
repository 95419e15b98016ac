#include "drive_diagnosis/instruments/mounting.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "drive_diagnosis/recording/robust_statistics.h"

namespace regoplan {
namespace {

constexpr double kReach_m = 1;

/// Angles of the ground and of the sensor, window by window.
struct AnglePairs {
  std::vector<double> ground, measured;
};

/// The middle of what the sensor says beyond the ground. Neighbouring windows err alike (the map
/// and its trees): the deviation counts one window in three.
std::optional<DriveEstimate> offset_of(const AnglePairs& pairs) {
  if (pairs.ground.size() < static_cast<std::size_t>(kMountingWindows)) return {};
  std::vector<double> off;
  for (std::size_t i = 0; i < pairs.ground.size(); ++i) {
    off.push_back(pairs.measured[i] - pairs.ground[i]);
  }
  const auto [middle, spread] = middle_and_scatter(std::move(off));
  const double independent = static_cast<double>(pairs.ground.size()) / 3;
  constexpr double kLeast_rad = 1e-4;
  return DriveEstimate{middle, std::max(kLeast_rad, 1.2533 * spread / std::sqrt(independent))};
}

/// Theil's slope: the median over pairs of windows that lie on different slopes.
double slope_of(const AnglePairs& pairs) {
  constexpr double kApart_rad = 0.05;
  std::vector<double> slopes;
  for (std::size_t i = 0; i < pairs.ground.size(); ++i) {
    for (std::size_t j = i + 1; j < std::min(pairs.ground.size(), i + 200); ++j) {
      const double run = pairs.ground[j] - pairs.ground[i];
      if (std::abs(run) < kApart_rad) continue;
      slopes.push_back((pairs.measured[j] - pairs.measured[i]) / run);
    }
  }
  return slopes.size() < 20 ? 1 : median_value(std::move(slopes));
}

double scatter_of(const std::vector<double>& angles_rad) {
  return angles_rad.empty() ? 0 : middle_and_scatter(angles_rad).scatter;
}

/// Days share one sensor: each one's estimate is drawn to the mean of all as far as its own scatter
/// is larger than that between days (empirical Bayes; DerSimonian and Laird's variance).
void share_between_days(std::vector<Mounting>& mountings,
                        std::optional<DriveEstimate> Mounting::*of) {
  double weights = 0, squares = 0, sum = 0, days = 0;
  for (const Mounting& day : mountings) {
    if (!(day.*of)) continue;
    const double weight = 1 / ((day.*of)->std * (day.*of)->std);
    weights += weight;
    squares += weight * weight;
    sum += weight * (day.*of)->value;
    ++days;
  }
  if (days < 3) return;
  const double mean = sum / weights;
  double excess = -(days - 1);
  for (const Mounting& day : mountings) {
    if (!(day.*of)) continue;
    excess +=
        ((day.*of)->value - mean) * ((day.*of)->value - mean) / ((day.*of)->std * (day.*of)->std);
  }
  const double between = std::max(0.0, excess / (weights - squares / weights));
  for (Mounting& day : mountings) {
    if (!(day.*of)) continue;
    const double own = (day.*of)->std * (day.*of)->std;
    const double share = between / (between + own);
    (day.*of)->value = mean + share * ((day.*of)->value - mean);
    (day.*of)->std = std::sqrt(share * own + (1 - share) * (1 - share) / weights);
  }
}

}  // namespace

std::optional<GroundAttitude> ground_attitude(const TerrainMap& map, double x_m, double y_m,
                                              double course_rad, double reach_m) {
  double along = 0, across = 0, weight = 0;
  const double c = std::cos(course_rad), s = std::sin(course_rad);
  for (int i = -1; i <= 1; ++i) {
    for (int j = -1; j <= 1; ++j) {
      const double u = i * reach_m, v = j * reach_m;
      const double z_m = map.height_m(x_m + c * u - s * v, y_m + s * u + c * v);
      if (std::isnan(z_m)) return {};
      along += z_m * u;
      across += z_m * v;
      weight += u * u;
    }
  }
  const double p = along / weight, q = across / weight;
  return GroundAttitude{std::atan(p), std::atan(q / std::sqrt(1 + p * p))};
}

double heading_rad(const DriveRecording& drive, const DriveWindow& window) {
  double wheels = channel_mean(drive, window, "command_speed");
  if (std::isnan(wheels) || wheels == 0) {
    wheels = 0;
    for (std::size_t i = 0; i < drive.channels.size(); ++i) {
      if (!drive.channels[i].name.starts_with("wheel_speed_")) continue;
      if (!std::isnan(window.channels[i])) wheels += window.channels[i];
    }
  }
  return window.course_rad + (wheels < 0 ? std::numbers::pi : 0.0);
}

std::vector<Mounting> find_mountings(const std::vector<DriveRecording>& drives,
                                     const std::vector<DriveWindow>& windows,
                                     const TerrainMap& map) {
  std::vector<Mounting> mountings;
  std::vector<AnglePairs> pitch, roll;
  for (const DriveWindow& window : windows) {
    const DriveRecording& drive = drives[window.drive];
    auto day = std::ranges::find(mountings, drive.day, &Mounting::day);
    if (day == mountings.end()) {
      mountings.push_back({.day = drive.day, .pitch_rad = {}, .roll_rad = {}});
      pitch.emplace_back();
      roll.emplace_back();
      day = mountings.end() - 1;
    }
    const auto at = static_cast<std::size_t>(day - mountings.begin());
    constexpr double kSteady_mps = 0.15, kStraight_rad_s = 0.08;
    if (!(window.speed_mps > kSteady_mps * window.pace) ||
        std::abs(window.yaw_rate_rad_s) > kStraight_rad_s * window.pace) {
      continue;
    }
    const auto ground =
        ground_attitude(map, window.x_m, window.y_m, heading_rad(drive, window), kReach_m);
    constexpr double kTree_rad = 0.6;
    if (!ground || std::hypot(ground->pitch_rad, ground->roll_rad) > kTree_rad) continue;
    if (!std::isnan(window.pitch_rad)) {
      pitch[at].ground.push_back(ground->pitch_rad);
      pitch[at].measured.push_back(window.pitch_rad);
    }
    if (!std::isnan(window.roll_rad)) {
      roll[at].ground.push_back(ground->roll_rad);
      roll[at].measured.push_back(window.roll_rad);
    }
  }
  for (std::size_t i = 0; i < mountings.size(); ++i) {
    mountings[i].pitch_rad = offset_of(pitch[i]);
    mountings[i].roll_rad = offset_of(roll[i]);
    mountings[i].pitch_slope = slope_of(pitch[i]);
    mountings[i].roll_slope = slope_of(roll[i]);
    mountings[i].pitch_scatter_rad = scatter_of(pitch[i].measured);
    mountings[i].pitch_ground_scatter_rad = scatter_of(pitch[i].ground);
    mountings[i].roll_scatter_rad = scatter_of(roll[i].measured);
    mountings[i].roll_ground_scatter_rad = scatter_of(roll[i].ground);
    mountings[i].windows = static_cast<int>(pitch[i].ground.size());
  }
  share_between_days(mountings, &Mounting::pitch_rad);
  share_between_days(mountings, &Mounting::roll_rad);
  return mountings;
}

}  // namespace regoplan
