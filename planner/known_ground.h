#pragma once

#include <cstdint>
#include <vector>

#include "maps/terrain_map.h"

namespace regoplan {

/// Tells where all ground is known, by tiles of the elevation raster that are looked at once.
class KnownGround {
 public:
  /// \param map must outlive it
  explicit KnownGround(const TerrainMap& map);

  /// Whether all of a square is; false also where a tile beside it is not.
  bool around(double x_m, double y_m, double half_m);

 private:
  static constexpr int kTile = 32;
  static constexpr std::int8_t kNotAsked = -1;

  bool known(int tile_column, int tile_row);

  const TerrainMap& map_;
  int columns_;
  std::vector<std::int8_t> tiles_;
};

}  // namespace regoplan
