#include "drive_diagnosis/comparison/swapped_sides.h"

#include <cmath>
#include <optional>
#include <string>

#include "drive_diagnosis/comparison/window_comparison.h"

namespace regoplan {
namespace {

/// Sum of squares of what the model leaves of torques, beside each wheel's mean; nothing where no
/// window can be compared.
std::optional<double> torque_misfit(const std::vector<DriveRecording>& drives,
                                    const std::vector<DriveWindow>& windows, const TerrainMap& map,
                                    const Vehicle& vehicle, double gravity_mps2, int threads,
                                    const std::stop_token& stop) {
  const WindowComparison comparison(drives, windows, map, vehicle, gravity_mps2, threads);
  if (comparison.size() == 0 || !comparison.has_torque()) return {};
  const Eigen::MatrixXd left = comparison.measured() - comparison.predicted_as_said(stop);
  double sum = 0;
  for (Eigen::Index k = 0; k < left.cols(); ++k) {
    if (!comparison.channels()[static_cast<std::size_t>(k)].starts_with("torque_")) continue;
    sum += (left.col(k).array() - left.col(k).mean()).square().sum();
  }
  return sum;
}

}  // namespace

std::vector<WheelPair> sides_across(const Vehicle* vehicle) {
  std::vector<WheelPair> pairs;
  if (vehicle != nullptr) pairs = wheels_across(*vehicle);
  pairs.emplace_back("left", "right");
  return pairs;
}

void exchange(std::string_view quantity, const std::vector<WheelPair>& pairs,
              std::vector<DriveRecording>& drives) {
  const std::string prefix = std::string(quantity) + "_";
  for (DriveRecording& drive : drives) {
    for (DriveChannel& channel : drive.channels) {
      if (!channel.name.starts_with(prefix)) continue;
      for (const auto& [left, right] : pairs) {
        const bool is_left = channel.name.starts_with(prefix + left + "_");
        if (!is_left && !channel.name.starts_with(prefix + right + "_")) continue;
        const std::string& from = is_left ? left : right;
        channel.name.replace(prefix.size(), from.size(), is_left ? right : left);
        break;
      }
    }
  }
}

bool torques_are_swapped(const std::vector<DriveRecording>& drives,
                         const std::vector<DriveWindow>& windows, const TerrainMap& map,
                         const Vehicle& vehicle, double gravity_mps2,
                         const std::vector<WheelPair>& pairs, int threads,
                         const std::stop_token& stop) {
  const auto misfit = [&](const std::vector<DriveRecording>& taken) {
    return torque_misfit(taken, windows, map, vehicle, gravity_mps2, threads, stop);
  };
  const auto told = misfit(drives);
  if (!told) return false;
  std::vector<DriveRecording> exchanged = drives;
  exchange("torque", pairs, exchanged);
  const auto other = misfit(exchanged);
  return other && *other < *told;
}

}  // namespace regoplan
