#pragma once

#include <nlohmann/json.hpp>

#include "planner/problem/terrain_rasters.h"

namespace regoplan {

/// What a vehicle may do on each part of a map, as reports colour the ground by it: the stability
/// margin, then the lateral supply at each speed.
///
/// Each layer has 256 cells a side at most and is base64 of bytes, row by row from the north: 1 to
/// 255 from `min` to `max`, the smallest of the cells that one stands for, 0 where none is known.
nlohmann::json report_layers(const TerrainRasters& rasters);

}  // namespace regoplan
