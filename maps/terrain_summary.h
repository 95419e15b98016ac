#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "maps/terrain_map.h"

namespace regoplan {

/// What a map holds, in numbers.
struct TerrainSummary {
  struct SoilShare {
    std::string name;
    double share = 0;
  };

  GridFrame frame;         ///< extent and cells of the elevation
  double known_share = 0;  ///< of the elevation cells
  double height_min_m = 0;
  double height_max_m = 0;
  /// Quantiles over the cells, from central differences between their four neighbours; NaN where
  /// no cell has four known ones. They depend on the cell size.
  double slope_p50_rad = 0;
  double slope_p90_rad = 0;
  double slope_p99_rad = 0;
  double slope_max_rad = 0;
  std::vector<SoilShare> soils;  ///< share of the elevation cells whose centre has that soil
  double no_soil_share = 0;      ///< of the elevation cells: forbidden
  std::size_t rocks = 0;
  double rock_share = 0;  ///< of the map's area, covered by rocks
};

TerrainSummary summarize(const TerrainMap& map);

}  // namespace regoplan
