#include "drive_diagnosis/comparison/torque_sign.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "drive_diagnosis/comparison/window_comparison.h"

namespace regoplan {
namespace {

std::string torque_of(const std::string& wheel) {
  return fmt::format("torque_{}_nm", wheel);
}

constexpr std::size_t kFewestWindows = 12;

/// Compared windows by drive.
std::vector<std::vector<Eigen::Index>> rows_by_drive(const WindowComparison& comparison,
                                                     const std::vector<DriveWindow>& windows,
                                                     std::size_t drives) {
  std::vector<std::vector<Eigen::Index>> rows(drives);
  for (std::size_t i = 0; i < comparison.size(); ++i) {
    rows[windows[comparison.window(i)].drive].push_back(static_cast<Eigen::Index>(i));
  }
  return rows;
}

/// Whether a model comes far nearer to what is told with the other sign: as it is, and with what is
/// the same in all windows taken off, as drag beside a slope that pushes may turn a torque round.
bool is_reversed(const Eigen::VectorXd& told, const Eigen::VectorXd& model) {
  constexpr double kShare = 0.25;
  const Eigen::VectorXd less = told - model, more = told + model;
  const auto varied = [](const Eigen::VectorXd& values) {
    return (values.array() - values.mean()).matrix().squaredNorm();
  };
  return more.squaredNorm() < kShare * less.squaredNorm() && varied(more) < kShare * varied(less);
}

/// Drives in which a wheel's torque is reversed. Drives too short to say follow those that are long
/// enough where these agree, and are judged together where there are none.
std::vector<std::size_t> reversed_drives(const std::vector<std::vector<Eigen::Index>>& rows,
                                         const Eigen::VectorXd& told,
                                         const Eigen::VectorXd& model) {
  std::vector<std::size_t> reversed, short_ones;
  std::vector<Eigen::Index> short_rows;
  std::size_t judged = 0;
  for (std::size_t drive = 0; drive < rows.size(); ++drive) {
    if (rows[drive].size() < kFewestWindows) {
      if (!rows[drive].empty()) short_ones.push_back(drive);
      std::ranges::copy(rows[drive], std::back_inserter(short_rows));
      continue;
    }
    ++judged;
    if (is_reversed(told(rows[drive]), model(rows[drive]))) reversed.push_back(drive);
  }
  const bool shorts_reversed = judged > 0 ? reversed.size() == judged
                                          : short_rows.size() >= kFewestWindows &&
                                                is_reversed(told(short_rows), model(short_rows));
  if (shorts_reversed) std::ranges::copy(short_ones, std::back_inserter(reversed));
  std::ranges::sort(reversed);
  return reversed;
}

}  // namespace

std::vector<ReversedTorque> wheels_with_torque_reversed(const std::vector<DriveRecording>& drives,
                                                        const std::vector<DriveWindow>& windows,
                                                        const TerrainMap& map,
                                                        const Vehicle& vehicle, double gravity_mps2,
                                                        int threads, const std::stop_token& stop) {
  const WindowComparison comparison(drives, windows, map, vehicle, gravity_mps2, threads);
  if (comparison.size() < kFewestWindows || !comparison.has_torque()) return {};
  const auto rows = rows_by_drive(comparison, windows, drives.size());
  const Eigen::MatrixXd model = comparison.predicted_as_said(stop);
  const Eigen::MatrixXd& told = comparison.measured();
  std::vector<ReversedTorque> result;
  for (const WheelMount& wheel : vehicle.wheels) {
    const auto channel = comparison.channel(torque_of(wheel.name));
    if (!channel) continue;
    const auto k = static_cast<Eigen::Index>(*channel);
    ReversedTorque reversed{.wheel = wheel.name,
                            .drives = reversed_drives(rows, told.col(k), model.col(k))};
    if (!reversed.drives.empty()) result.push_back(std::move(reversed));
  }
  return result;
}

void reverse_torque(const ReversedTorque& reversed, std::vector<DriveRecording>& drives,
                    std::vector<DriveWindow>& windows) {
  const std::string name = torque_of(reversed.wheel);
  const auto is_its = [&](std::size_t drive) {
    return std::ranges::find(reversed.drives, drive) != reversed.drives.end();
  };
  for (DriveWindow& window : windows) {
    if (!is_its(window.drive)) continue;
    const std::vector<DriveChannel>& channels = drives[window.drive].channels;
    for (std::size_t k = 0; k < channels.size(); ++k) {
      if (channels[k].name == name) window.channels[k] = -window.channels[k];
    }
  }
  for (const std::size_t drive : reversed.drives) {
    DriveChannel* torque = drives[drive].channel(name);
    if (torque == nullptr) continue;
    for (float& value : torque->values) value = -value;
  }
}

}  // namespace regoplan
