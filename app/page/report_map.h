#pragma once

#include <nlohmann/json.hpp>

#include "maps/terrain_map.h"

namespace regoplan {

/// How much of a map a report holds.
struct ReportMapDetail {
  int cells_a_side = 512;
  std::size_t rocks = 20000;
};

/// A map as reports draw it: extent, elevation and soils as small rasters, soils with their
/// numbers, rocks.
///
/// Both rasters have no more cells a side than `detail` says and are base64 of little-endian 16-bit
/// numbers, row by row from the north: elevation as 1 to 65535 from `min_m` to `max_m`, each the
/// mean of the known cells it stands for, 0 where half of them or more are unknown; soil as index +
/// 1, 0 where it is unknown or forbidden, taken at the middle. Of more rocks than `detail` says the
/// largest stand.
nlohmann::json report_map(const TerrainMap& map, const ReportMapDetail& detail = {});

}  // namespace regoplan
