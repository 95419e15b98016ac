#pragma once

#include <stop_token>
#include <string>
#include <vector>

#include "app/io/staged_files.h"
#include "maps/terrain_map.h"

namespace regoplan {

/// Writes dem.tif, soils.yaml and, where the map has them, classes.tif and rocks.csv, as a
/// scenario's `map` names them. A raster or rocks of an earlier map that this one has not are taken
/// away. \returns false where it was asked to stop \throws InputError where a file cannot be
/// written
bool write_map_files(const TerrainMap& map, StagedFiles& files, const std::stop_token& stop = {});

/// Its files, whatever the map has.
std::vector<std::string> map_file_names();

}  // namespace regoplan
