#pragma once

#include <stop_token>
#include <string>
#include <vector>

#include "app/io/staged_files.h"
#include "app/map/scenario_stub.h"
#include "maps/terrain_map.h"

namespace regoplan {

/// Writes a map as dem.tif, classes.tif, soils.yaml, rocks.csv and scenario.yaml, and a copy of
/// the vehicle file, all or none.
/// \returns false where it was asked to stop, and has written none
/// \throws InputError as `stub_files`, and where the folder takes no files
bool write_map_folder(const TerrainMap& map, const ScenarioStub& stub, const ResultFolder& folder,
                      const std::stop_token& stop);

/// Its files, whatever the map has.
std::vector<std::string> map_folder_names();

}  // namespace regoplan
