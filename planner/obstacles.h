#pragma once

#include <memory>

#include "maps/terrain_map.h"
#include "terramech/ground_patch.h"
#include "terramech/vehicle.h"

namespace regoplan {

/// Collision of a vehicle with the rocks and the terrain of a map, by FCL. The vehicle is its body
/// box and a box around each wheel that begins at the height of the steps it drives over; rocks are
/// vertical cylinders; terrain is the triangle mesh of the elevation cells. Safe from many threads.
class Obstacles {
 public:
  /// \param clearance_m every part of the vehicle is enlarged by this, sideways; downwards its body
  /// is by as much, but no more than a tenth of its height over the ground
  /// \note map and vehicle must outlive it
  Obstacles(const TerrainMap& map, const Vehicle& vehicle, double clearance_m);
  ~Obstacles();
  Obstacles(const Obstacles&) = delete;
  Obstacles& operator=(const Obstacles&) = delete;

  /// Whether the vehicle, standing on the patch, touches a rock or, with its body, the ground.
  bool hit(double x_m, double y_m, double yaw_rad, const GroundPatch& patch) const;

 private:
  struct Shapes;
  std::unique_ptr<Shapes> shapes_;
};

}  // namespace regoplan
