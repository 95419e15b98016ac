#pragma once

#include <string>
#include <vector>

#include "maps/terrain_map.h"
#include "terramech/parameters/vehicle.h"

namespace regoplan {

/// What somebody should know of a map's elevations before a vehicle is planned over them, a
/// sentence each: cells wider than the vehicle, heights in whole metres on small cells.
std::vector<std::string> map_notices(const TerrainMap& map, const Vehicle& vehicle);

}  // namespace regoplan
