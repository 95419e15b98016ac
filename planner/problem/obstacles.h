#pragma once

#include <memory>

#include "maps/terrain_map.h"
#include "terramech/parameters/ground_patch.h"
#include "terramech/parameters/vehicle.h"
#include "terramech/vehicle/vehicle_dynamics.h"

namespace regoplan {

/// Collision of a vehicle with the rocks and the terrain of a map, by FCL. Rocks are vertical
/// cylinders on the ground; terrain is the triangle mesh of the elevation cells. Ground that is
/// unknown is where the plane of the contacts runs, for rocks on it and for the mesh about it. Safe
/// from many threads.
///
/// The body's box clears the ground and every rock, low as it may be. Each wheel is a box, turned
/// as its steering is set, that begins `step_max_m` above the plane of the contacts; rocks up to
/// `step_max_m` high are rolled over, so that only higher ones stop it. Pose and contacts are those
/// of the elevation alone: how a wheel on a rock lifts and tilts the vehicle is not modelled (a
/// body on four equal springs rises by a quarter of the rock in its middle).
class Obstacles {
 public:
  /// \param clearance_m every part of the vehicle is enlarged by this, sideways; downwards its body
  /// is by as much, but no more than a tenth of its height over the ground
  /// \note map and vehicle must outlive it
  Obstacles(const TerrainMap& map, const Vehicle& vehicle, double clearance_m);
  Obstacles(TerrainMap&& gone, const Vehicle& vehicle, double clearance_m) = delete;
  Obstacles(const TerrainMap& map, Vehicle&& gone, double clearance_m) = delete;
  ~Obstacles();
  Obstacles(const Obstacles&) = delete;
  Obstacles& operator=(const Obstacles&) = delete;

  /// Whether the vehicle, standing on the patch with its wheels steered as commanded, touches a
  /// rock or, with its body, the ground. Of the state, pose and commanded steering count.
  bool hit(const VehicleState& state, const GroundPatch& patch) const;

 private:
  struct Shapes;
  std::unique_ptr<Shapes> shapes_;
};

/// Roughly whether a vehicle cannot pass over a rock whatever its heading: higher than its steps,
/// or on ground so much higher than that around that it reaches the body. For guidance only.
bool in_the_way(const TerrainMap& map, const Vehicle& vehicle, const Rock& rock);

}  // namespace regoplan
