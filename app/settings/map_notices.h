#pragma once

#include <string>
#include <vector>

#include "maps/terrain_map.h"
#include "terramech/parameters/vehicle.h"

namespace regoplan {

/// What somebody should know of a map's elevations before a vehicle is planned over them, a
/// sentence each: cells wider than the vehicle, heights in whole metres on small cells.
std::vector<std::string> map_notices(const TerrainMap& map, const Vehicle& vehicle);

/// Of a map without a soil for unmapped ground: the codes of its class raster that its soils do not
/// list, whose cells nobody may enter. Empty where there are none.
/// \param raster what the codes stand in, for the sentence
std::string unlisted_classes_notice(const TerrainMap& map, const std::string& raster);

/// Of a class raster that leaves part of the elevations out: how much of them, and what their soil
/// is taken for. Empty where it leaves nothing out, but for the margin that grids of different
/// cells have. \param raster what the classes stand in
std::string uncovered_notice(const TerrainMap& map, const std::string& raster);

/// Of the rocks that lie wholly off the map, where no path can meet them: where each stands, and
/// where the map ends. Empty where there are none. \param source what the rocks stand in
std::string rocks_off_map_notice(const TerrainMap& map, const std::string& source);

}  // namespace regoplan
