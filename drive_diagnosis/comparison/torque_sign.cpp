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

/// Compared windows of drives that are judged together.
struct Judged {
  std::vector<std::size_t> drives;
  std::vector<Eigen::Index> rows;
};

std::vector<Judged> judged_together(const WindowComparison& comparison,
                                    const std::vector<DriveWindow>& windows, std::size_t drives) {
  constexpr std::size_t kFewest = 12;
  std::vector<Judged> each(drives);
  for (std::size_t i = 0; i < comparison.size(); ++i) {
    each[windows[comparison.window(i)].drive].rows.push_back(static_cast<Eigen::Index>(i));
  }
  std::vector<Judged> judged;
  Judged short_ones;
  for (std::size_t drive = 0; drive < drives; ++drive) {
    each[drive].drives = {drive};
    if (each[drive].rows.size() >= kFewest) {
      judged.push_back(std::move(each[drive]));
      continue;
    }
    short_ones.drives.push_back(drive);
    std::ranges::copy(each[drive].rows, std::back_inserter(short_ones.rows));
  }
  if (short_ones.rows.size() >= kFewest) judged.push_back(std::move(short_ones));
  return judged;
}

}  // namespace

std::vector<ReversedTorque> wheels_with_torque_reversed(const std::vector<DriveRecording>& drives,
                                                        const std::vector<DriveWindow>& windows,
                                                        const TerrainMap& map,
                                                        const Vehicle& vehicle, double gravity_mps2,
                                                        int threads, const std::stop_token& stop) {
  constexpr double kShare = 0.25;
  const WindowComparison comparison(drives, windows, map, vehicle, gravity_mps2, threads);
  const std::vector<Judged> judged = judged_together(comparison, windows, drives.size());
  if (judged.empty() || !comparison.has_torque()) return {};
  const Eigen::MatrixXd model = comparison.predicted_as_said(stop);
  const Eigen::MatrixXd less = comparison.measured() - model, more = comparison.measured() + model;
  std::vector<ReversedTorque> result;
  for (const WheelMount& wheel : vehicle.wheels) {
    const auto channel = comparison.channel(torque_of(wheel.name));
    if (!channel) continue;
    const auto k = static_cast<Eigen::Index>(*channel);
    ReversedTorque reversed{.wheel = wheel.name, .drives = {}};
    for (const Judged& these : judged) {
      if (more(these.rows, k).squaredNorm() < kShare * less(these.rows, k).squaredNorm()) {
        std::ranges::copy(these.drives, std::back_inserter(reversed.drives));
      }
    }
    std::ranges::sort(reversed.drives);
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
