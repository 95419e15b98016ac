#pragma once

#include <filesystem>

#include "app/scenario_stub.h"
#include "maps/terrain_map.h"

namespace regoplan {

/// Writes a map as dem.tif, classes.tif, soils.yaml, rocks.csv and scenario.yaml, and a copy of
/// the vehicle file, all or none.
/// \throws InputError as `stub_files`, and where the folder takes no files
void write_map_folder(const TerrainMap& map, const ScenarioStub& stub,
                      const std::filesystem::path& folder);

}  // namespace regoplan
