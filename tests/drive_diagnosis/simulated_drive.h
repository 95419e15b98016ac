#pragma once

#include <cstdint>
#include <functional>

#include "drive_diagnosis/drive_recording.h"
#include "drive_diagnosis/window_prediction.h"
#include "maps/terrain_map.h"

namespace regoplan {

/// A drive of 300 m for tests of the diagnosis' own machinery. Its ground and vehicle obey
/// `terramech`, as the diagnosis does: no proof of what is found in the field.
struct SimulatedDrive {
  /// Weakness of the soil at a place, in standard deviations of `weaker`.
  std::function<double(double x_m)> weakness = [](double) { return 0.0; };
  VehicleDeviation deviation{};  ///< drags, motors and offsets of steering; nothing else
  double torque_scatter = 0.03;  ///< share, of a metre of ground
  std::uint64_t seed = 1;
};

/// 320 m by 60 m of rolling ground of one soil.
TerrainMap rolling_map();

/// Pose at 1 Hz within 2 cm and 1 deg, wheel speeds within 1 % at 10 Hz.
DriveRecording record(const SimulatedDrive& drive, const TerrainMap& map);

}  // namespace regoplan
