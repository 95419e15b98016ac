#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "maps/crater_shape.h"
#include "maps/terrain_map.h"

namespace regoplan {

/// A crater of a synthetic surface. Its rim is a circle with a few low waves.
struct Crater {
  /// No point of the rim lies further out than this, in mean radii.
  static constexpr double kRimMax = 1.25;

  double x_m = 0;
  double y_m = 0;
  double diameter_m = 0;
  double age = 0;                    ///< diffusivity x time / radius^2, see CraterShape
  std::array<double, 4> wave_cos{};  ///< of the waves 2, 3, 4, 5 along the rim, in radii
  std::array<double, 4> wave_sin{};

  /// 1 for the youngest, falling to nearly 0 where rim and rocks have gone.
  double freshness() const;
  /// Distance from the centre in radii of the rim in that direction.
  double distance(double x_at_m, double y_at_m) const;
};

/// Calls `visit(cell, x_m, y_m, distance)` for every cell whose centre lies closer to the crater's
/// than `reach` radii; distance in radii, cells counted row by row from the north.
template <typename Visit>
void for_cells_around(const Crater& crater, double reach, const GridFrame& frame, Visit visit) {
  const double reach_m = 0.5 * reach * crater.diameter_m * Crater::kRimMax;
  const auto cell = [](double offset, int count) {
    return static_cast<int>(std::clamp(std::floor(offset), 0.0, static_cast<double>(count)));
  };
  const double column = (crater.x_m - frame.west_m) / frame.cell_width_m;
  const double row = (frame.north_m - crater.y_m) / frame.cell_height_m;
  const double columns = reach_m / frame.cell_width_m;
  const double rows = reach_m / frame.cell_height_m;
  const int row_end = cell(row + rows + 1, frame.rows);
  const int column_begin = cell(column - columns, frame.columns);
  const int column_end = cell(column + columns + 1, frame.columns);
  for (int r = cell(row - rows, frame.rows); r < row_end; ++r) {
    const double y_m = frame.north_m - (r + 0.5) * frame.cell_height_m;
    for (int c = column_begin; c < column_end; ++c) {
      const double x_m = frame.west_m + (c + 0.5) * frame.cell_width_m;
      if (std::pow(x_m - crater.x_m, 2) + std::pow(y_m - crater.y_m, 2) >= reach_m * reach_m)
        continue;
      const double distance = crater.distance(x_m, y_m);
      if (distance >= reach) continue;
      visit(static_cast<std::size_t>(r) * static_cast<std::size_t>(frame.columns) +
                static_cast<std::size_t>(c),
            x_m, y_m, distance);
    }
  }
}

/// Draws the craters of a surface in equilibrium, oldest first, on the extent of `frame` and around
/// it as far as their ejecta reach in.
///
/// Count: cumulative density 0.079 D^-2 a square metre (Trask 1966; 5 % of geometric saturation,
/// Gault 1970) times `density_scale`, between the two diameters. Age: uniform up to where a crater
/// is gone, as in a steady state; so few are fresh (Basilevsky 1976: one in ten).
std::vector<Crater> draw_craters(const GridFrame& frame, double diameter_min_m,
                                 double diameter_max_m, double density_scale, std::uint64_t seed);

/// Digs the craters into the heights one after another: inside its rim each replaces what was there
/// by its own shape on the plane that fits the older ground best. Ground steeper than 37 deg
/// slides. \returns the heights row by row from the north, in the order of `frame`
std::vector<double> with_craters(std::vector<double> height_m, const GridFrame& frame,
                                 const std::vector<Crater>& craters);

}  // namespace regoplan
