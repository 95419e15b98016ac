#include "drive_diagnosis/comparison/torque_sign.h"

#include <fmt/format.h>

#include "drive_diagnosis/comparison/window_comparison.h"

namespace regoplan {
namespace {

std::string torque_of(const std::string& wheel) {
  return fmt::format("torque_{}_nm", wheel);
}

}  // namespace

std::vector<std::string> wheels_with_torque_reversed(const std::vector<DriveRecording>& drives,
                                                     const std::vector<DriveWindow>& windows,
                                                     const TerrainMap& map, const Vehicle& vehicle,
                                                     double gravity_mps2, int threads,
                                                     const std::stop_token& stop) {
  constexpr std::size_t kFewest = 12;
  constexpr double kShare = 0.25;
  const WindowComparison comparison(drives, windows, map, vehicle, gravity_mps2, threads);
  if (comparison.size() < kFewest || !comparison.has_torque()) return {};
  const Eigen::MatrixXd model = comparison.predicted_as_said(stop);
  const Eigen::MatrixXd& told = comparison.measured();
  std::vector<std::string> reversed;
  for (const WheelMount& wheel : vehicle.wheels) {
    const auto channel = comparison.channel(torque_of(wheel.name));
    if (!channel) continue;
    const auto k = static_cast<Eigen::Index>(*channel);
    const double as_told = (told.col(k) - model.col(k)).squaredNorm();
    if ((told.col(k) + model.col(k)).squaredNorm() < kShare * as_told) {
      reversed.push_back(wheel.name);
    }
  }
  return reversed;
}

void reverse_torque(const std::string& wheel, std::vector<DriveRecording>& drives,
                    std::vector<DriveWindow>& windows) {
  for (DriveWindow& window : windows) {
    const std::vector<DriveChannel>& channels = drives[window.drive].channels;
    for (std::size_t k = 0; k < channels.size(); ++k) {
      if (channels[k].name == torque_of(wheel)) window.channels[k] = -window.channels[k];
    }
  }
  for (DriveRecording& drive : drives) {
    DriveChannel* torque = drive.channel(torque_of(wheel));
    if (torque == nullptr) continue;
    for (float& value : torque->values) value = -value;
  }
}

}  // namespace regoplan
