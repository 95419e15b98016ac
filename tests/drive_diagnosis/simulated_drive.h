#pragma once

#include <cmath>
#include <cstdint>
#include <functional>

#include "drive_diagnosis/comparison/window_prediction.h"
#include "drive_diagnosis/recording/drive_recording.h"
#include "maps/terrain_map.h"

namespace regoplan {

/// A drive of 300 m for tests of the diagnosis' own machinery. Its ground and vehicle obey
/// `terramech`, as the diagnosis does: no proof of what is found in the field.
struct SimulatedDrive {
  /// Weakness of the soil under a wheel, in standard deviations of `weaker`.
  std::function<double(double x_m)> weakness = [](double) { return 0.0; };
  VehicleDeviation deviation{};  ///< drags, motors, steering, torque by load, tilt; nothing else
  double torque_scatter = 0.03;  ///< share, of a metre of ground
  double sensor_noise = 1;       ///< times that of `record`
  double fixes_s = 1;            ///< from pose to pose
  /// What is commanded, over time and way; curvature besides what holds the way.
  std::function<double(double time_s, double x_m)> speed_mps = [](double, double x_m) {
    return 1.2 + 0.3 * std::sin(x_m / 23);
  };
  std::function<double(double time_s, double x_m)> weave_1pm = [](double, double x_m) {
    return 0.06 * std::sin(x_m / 9);
  };
  bool attitude = false;  ///< whether pitch and roll are told, within .3 deg
  std::uint64_t seed = 1;
};

/// 320 m by 60 m of one soil, a height for each square metre from the west and from the north.
TerrainMap map_of_heights(const std::function<double(int column, int row)>& height_m);
/// As much of rolling ground.
TerrainMap rolling_map();

/// Pose at 1 Hz within 2 cm and 1 deg, wheel speeds within 1 % at 10 Hz.
DriveRecording record(const SimulatedDrive& drive, const TerrainMap& map);

}  // namespace regoplan
