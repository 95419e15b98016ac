#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "maps/terrain_map.h"

namespace regoplan {

/// Tells where all ground is known, by tiles of the elevation raster that are looked at when first
/// asked for. Safe from many threads.
class KnownGround {
 public:
  /// \param map must outlive it
  explicit KnownGround(const TerrainMap& map);
  explicit KnownGround(TerrainMap&& gone) = delete;

  /// Whether all of a square is; false also where a tile beside it is not.
  bool around(double x_m, double y_m, double half_m) const;

 private:
  static constexpr int kTile = 32;
  enum class Answer : std::int8_t { kNotAsked, kUnknown, kKnown };

  bool known(int tile_column, int tile_row) const;

  const TerrainMap& map_;
  int columns_;
  mutable std::vector<std::atomic<Answer>> tiles_;
};

}  // namespace regoplan
