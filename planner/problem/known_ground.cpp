#include "planner/problem/known_ground.h"

#include <algorithm>
#include <cmath>

namespace regoplan {

KnownGround::KnownGround(const TerrainMap& map)
    : map_(map),
      columns_(map.elevation().frame.columns / kTile + 1),
      tiles_(static_cast<std::size_t>(columns_) *
             static_cast<std::size_t>(map.elevation().frame.rows / kTile + 1)) {}

bool KnownGround::around(double x_m, double y_m, double half_m) const {
  if (!map_.inside(x_m - half_m, y_m - half_m) || !map_.inside(x_m + half_m, y_m + half_m)) {
    return false;
  }
  const GridFrame& frame = map_.elevation().frame;
  const auto column = [&](double x) {
    return static_cast<int>((x - frame.west_m) / frame.cell_width_m) / kTile;
  };
  const auto row = [&](double y) {
    return static_cast<int>((frame.north_m - y) / frame.cell_height_m) / kTile;
  };
  for (int r = row(y_m + half_m); r <= row(y_m - half_m); ++r) {
    for (int c = column(x_m - half_m); c <= column(x_m + half_m); ++c) {
      if (!known(c, r)) return false;
    }
  }
  return true;
}

bool KnownGround::known(int tile_column, int tile_row) const {
  std::atomic<Answer>& answer =
      tiles_[static_cast<std::size_t>(tile_row) * static_cast<std::size_t>(columns_) +
             static_cast<std::size_t>(tile_column)];
  if (answer != Answer::kNotAsked) return answer == Answer::kKnown;
  const GridFrame& frame = map_.elevation().frame;
  // Two threads may look at once; they find the same.
  bool all = true;
  for (int r = tile_row * kTile; r < std::min(frame.rows, (tile_row + 1) * kTile); ++r) {
    for (int c = tile_column * kTile; c < std::min(frame.columns, (tile_column + 1) * kTile); ++c) {
      const double x = frame.west_m + (c + 0.5) * frame.cell_width_m;
      const double y = frame.north_m - (r + 0.5) * frame.cell_height_m;
      if (std::isnan(map_.height_m(x, y)) || !map_.soil_index(x, y)) all = false;
    }
  }
  answer = all ? Answer::kKnown : Answer::kUnknown;
  return all;
}

}  // namespace regoplan
