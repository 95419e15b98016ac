#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "maps/terrain_map.h"
#include "maps/terrain_summary.h"

namespace regoplan {

/// A map's summary for people, a few lines; without soils where the map is a bare raster.
std::string summary_text(const TerrainSummary& summary, bool with_soils);

nlohmann::ordered_json summary_json(const TerrainSummary& summary, bool with_soils);

/// Says what a new map in `folder` holds: JSON, text or nothing.
void print_map_written(const TerrainMap& map, const std::filesystem::path& folder, bool json,
                       bool quiet);

}  // namespace regoplan
