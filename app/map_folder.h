#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "maps/terrain_map.h"

namespace regoplan {

/// What the scenario beside a map says, for a person to go on from.
struct ScenarioStub {
  std::string vehicle;
  double gravity_mps2 = 0;
};

/// Writes a map as dem.tif, classes.tif, soils.yaml, rocks.csv and scenario.yaml, all or none.
/// \throws InputError where the folder takes no files
void write_map_folder(const TerrainMap& map, const ScenarioStub& stub,
                      const std::filesystem::path& folder);

/// The place nearest to (x, y) where a vehicle can stand: known, soil that may be driven, no rock
/// within `clearance_m`, slope below 10 deg. Nothing where the map has none.
std::optional<std::pair<double, double>> free_place_near(const TerrainMap& map, double x_m,
                                                         double y_m, double clearance_m);

}  // namespace regoplan
