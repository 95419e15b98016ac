#pragma once

#include <optional>
#include <string>
#include <vector>

#include "drive_diagnosis/recording/drive_windows.h"
#include "maps/terrain_map.h"

namespace regoplan {

/// A number with its standard deviation.
struct DriveEstimate {
  double value = 0;
  double std = 0;
};

/// How the attitude sensor sits on the vehicle on one day: measured - ground, radians. From windows
/// that drive straight over known ground.
struct Mounting {
  std::string day;
  std::optional<DriveEstimate> pitch_rad, roll_rad;
  double pitch_slope = 1;  ///< measured over ground; near -1: the sign is wrong
  double roll_slope = 1;
  /// How far readings scatter from window to window, and the ground of the map; 0 of too few.
  double pitch_scatter_rad = 0, pitch_ground_scatter_rad = 0;
  double roll_scatter_rad = 0, roll_ground_scatter_rad = 0;
  int windows = 0;
};

/// Pitch and roll that the ground gives a vehicle heading along `course_rad` at a place: of the
/// plane through the heights within `reach_m`. Nothing where any of them is unknown.
struct GroundAttitude {
  double pitch_rad = 0, roll_rad = 0;
};
std::optional<GroundAttitude> ground_attitude(const TerrainMap& map, double x_m, double y_m,
                                              double course_rad, double reach_m);

/// The heading of a window on the map: its track, turned where it drives backwards.
double heading_rad(const DriveRecording& drive, const DriveWindow& window);

/// The mounting of each day, in the order in which the days come. A day's is nothing where fewer
/// than `kMountingWindows` windows lie on known ground; three days or more tell of each other.
inline constexpr int kMountingWindows = 15;
std::vector<Mounting> find_mountings(const std::vector<DriveRecording>& drives,
                                     const std::vector<DriveWindow>& windows,
                                     const TerrainMap& map);

}  // namespace regoplan
