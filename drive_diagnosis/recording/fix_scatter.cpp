#include "drive_diagnosis/recording/fix_scatter.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "drive_diagnosis/recording/robust_statistics.h"

namespace regoplan {

FixScatter fix_scatter(const DriveRecording& drive) {
  std::vector<double> time_s, xs, ys, yaw_time_s, yaws;
  const DriveChannel* yaw = drive.channel("yaw_rad");
  for (std::size_t i = 0; i < drive.size(); ++i) {
    if (!std::isnan(drive.x_m[i])) {
      time_s.push_back(drive.time_s[i]);
      xs.push_back(drive.x_m[i]);
      ys.push_back(drive.y_m[i]);
    }
    if (!yaw || std::isnan(yaw->values[i])) continue;
    const auto value = static_cast<double>(yaw->values[i]);
    const double last = yaws.empty() ? value : yaws.back();
    yaw_time_s.push_back(drive.time_s[i]);
    yaws.push_back(last + std::remainder(value - last, 2 * std::numbers::pi));
  }
  return {.position_m = std::hypot(scatter_of_samples(time_s, xs), scatter_of_samples(time_s, ys)) /
                        std::numbers::sqrt2,
          .yaw_rad = scatter_of_samples(yaw_time_s, yaws)};
}

}  // namespace regoplan
