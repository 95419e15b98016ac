#pragma once

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "drive_diagnosis/comparison/window_comparison.h"
#include "tests/drive_diagnosis/simulated_drive.h"

namespace regoplan {

/// Windows of a drive without scatter, compared.
struct Compared {
  explicit Compared(SimulatedDrive drive) : map(rolling_map()), vehicle(preset_vehicle("lrv")) {
    drive.sensor_noise = drive.torque_scatter = 0;
    drives = {record(drive, map)};
    windows = drive_windows(drives[0], 0, 5, 0.3);
    comparison.emplace(drives, windows, map, vehicle, 1.62, 2);
  }

  /// Root mean square of measured - predicted, by channel.
  std::vector<double> rms() const {
    const Eigen::MatrixXd off = comparison->measured() - comparison->predicted_as_said({});
    std::vector<double> result;
    for (Eigen::Index k = 0; k < off.cols(); ++k) {
      result.push_back(std::sqrt(off.col(k).squaredNorm() / static_cast<double>(off.rows())));
    }
    return result;
  }

  TerrainMap map;
  Vehicle vehicle;
  std::vector<DriveRecording> drives;
  std::vector<DriveWindow> windows;
  std::optional<WindowComparison> comparison;
};

/// A drive over a soft stretch, and where that lies along its windows.
struct OverAStretch : Compared {
  static constexpr double kFrom_m = 140, kTo_m = 170, kWeakness = 4;
  explicit OverAStretch(SimulatedDrive drive = {})
      : Compared(over_a_stretch(std::move(drive))),
        zone{.begins = window_at(kFrom_m),
             .ends = window_at(kTo_m),
             .numbers = weaker_by(kWeakness)} {}

  static SimulatedDrive over_a_stretch(SimulatedDrive drive) {
    drive.weakness = [](double x_m) { return x_m > kFrom_m && x_m < kTo_m ? kWeakness : 0; };
    return drive;
  }

  double window_at(double x_m) const {
    for (std::size_t i = 0; i + 1 < comparison->size(); ++i) {
      const double here_m = windows[comparison->window(i)].x_m;
      const double next_m = windows[comparison->window(i + 1)].x_m;
      if (x_m >= here_m && x_m < next_m) {
        return static_cast<double>(i) + 0.5 + (x_m - here_m) / (next_m - here_m);
      }
    }
    return NAN;
  }

  Eigen::MatrixXd predicted(const std::vector<WindowZone>& zones) const {
    const Eigen::MatrixXd& measured = comparison->measured();
    return comparison->predicted(comparison->all(), {}, zones,
                                 Eigen::MatrixXd::Zero(measured.rows(), measured.cols()), {});
  }

  WindowZone zone;
};

}  // namespace regoplan
