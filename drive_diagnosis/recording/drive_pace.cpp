#include "drive_diagnosis/recording/drive_pace.h"

#include <algorithm>
#include <cmath>

#include "drive_diagnosis/recording/fix_scatter.h"
#include "drive_diagnosis/recording/robust_statistics.h"

namespace regoplan {

DrivenWay driven_way(const DriveRecording& drive) {
  constexpr double kShortest_m = 1, kScatters = 10;
  const double leg_m = std::max(kShortest_m, kScatters * fix_scatter(drive).position_m);
  DrivenWay way;
  std::vector<double> speeds_mps;
  std::optional<std::size_t> from;
  for (std::size_t i = 0; i < drive.size(); ++i) {
    if (std::isnan(drive.x_m[i])) continue;
    if (from) {
      const double far_m =
          std::hypot(drive.x_m[i] - drive.x_m[*from], drive.y_m[i] - drive.y_m[*from]);
      if (far_m < leg_m) continue;
      way.way_m += far_m;
      speeds_mps.push_back(far_m / (drive.time_s[i] - drive.time_s[*from]));
    }
    from = i;
  }
  if (!speeds_mps.empty()) way.usual_speed_mps = median_value(std::move(speeds_mps));
  return way;
}

double pace_of(const DriveRecording& drive) {
  constexpr double kFast_mps = 0.4, kLeast = 0.02;
  const auto usual_mps = driven_way(drive).usual_speed_mps;
  return usual_mps ? std::clamp(*usual_mps / kFast_mps, kLeast, 1.0) : 1;
}

std::vector<double> window_lengths_s(const std::vector<DriveRecording>& drives, double shortest_s) {
  constexpr double kShortest_m = 1, kLongest_m = 4;
  constexpr double kLeftOver = 0.95;  // what stands, and ends of recordings, take windows too
  std::vector<DrivenWay> ways;
  double all_m = 0;
  for (const DriveRecording& drive : drives) all_m += ways.emplace_back(driven_way(drive)).way_m;
  const double fits_m = all_m / (kLeftOver * kComparedMost);
  std::vector<double> lengths_s;
  for (const DrivenWay& way : ways) {
    const bool slow = way.usual_speed_mps && *way.usual_speed_mps * shortest_s < kShortest_m;
    lengths_s.push_back(slow ? std::clamp(fits_m, kShortest_m, kLongest_m) / *way.usual_speed_mps
                             : shortest_s);
  }
  return lengths_s;
}

}  // namespace regoplan
