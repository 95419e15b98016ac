#pragma once

#include <array>

#include "maps/terrain_map.h"
#include "terramech/parameters/ground_patch.h"
#include "terramech/parameters/vehicle.h"

namespace regoplan {

/// Finds the ground under one vehicle on one map: the plane that fits the heights at its wheels'
/// contacts best, the soil under each, and the curvature along the heading over a wheelbase ahead
/// and behind (0 where the ground there is unknown). Both must outlive it; safe from many threads.
class GroundFinder {
 public:
  GroundFinder(const TerrainMap& map, const Vehicle& vehicle);
  GroundFinder(TerrainMap&& gone, const Vehicle& vehicle) = delete;
  GroundFinder(const TerrainMap& map, Vehicle&& gone) = delete;

  /// \param x_m, y_m below the centre of gravity \param yaw_rad heading from +x toward +y
  GroundPatch at(double x_m, double y_m, double yaw_rad) const;

 private:
  const TerrainMap& map_;
  const Vehicle& vehicle_;
  std::array<std::array<double, 3>, kMaxWheels> fit_{};  ///< height -> (z, slope forward, left)
  double wheelbase_m_ = 0;
};

}  // namespace regoplan
