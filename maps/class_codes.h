#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "maps/terrain_map.h"

namespace regoplan {

/// A code that a class raster holds and the soils do not list.
struct UnlistedCode {
  std::int32_t code = 0;
  std::size_t cells = 0;  ///< of the class raster
};

/// The commonest first; cells without a code (nodata) do not count.
std::vector<UnlistedCode> unlisted_codes(const TerrainMap& map);

/// Why there is no soil at (x, y), where `soil_index` finds none, and what to add to the soils:
/// "the soil classes hold the code 5 there ..."
std::string why_no_soil(const TerrainMap& map, double x_m, double y_m);

}  // namespace regoplan
