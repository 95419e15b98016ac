#include "maps/terrain_summary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace regoplan {

namespace {

/// Squares of the slopes' tangents, in which quantiles lie in the same order as in the angles.
std::vector<float> squared_rises(const ElevationRaster& elevation) {
  const GridFrame& frame = elevation.frame;
  const double per_x = 1 / (2 * frame.cell_width_m), per_y = 1 / (2 * frame.cell_height_m);
  std::vector<float> rises(elevation.height_m.size());
  std::size_t count = 0;
  for (int row = 1; row + 1 < frame.rows; ++row) {
    const float* cell =
        elevation.height_m.data() + static_cast<std::ptrdiff_t>(row) * frame.columns;
    for (int column = 1; column + 1 < frame.columns; ++column) {
      const double along_x = per_x * (cell[column + 1] - cell[column - 1]);
      const double along_y = per_y * (cell[column - frame.columns] - cell[column + frame.columns]);
      const auto rise = static_cast<float>(along_x * along_x + along_y * along_y);
      rises[count] = rise;
      count += std::isnan(rise) ? 0 : 1;
    }
  }
  rises.resize(count);
  return rises;
}

/// The slopes at these shares of the cells, which ascend: each quantile is sought above the last.
std::array<double, 4> slope_quantiles_rad(const ElevationRaster& elevation,
                                          const std::array<double, 4>& shares) {
  std::vector<float> rises = squared_rises(elevation);
  std::array<double, 4> slopes_rad{};
  slopes_rad.fill(std::numeric_limits<double>::quiet_NaN());
  if (rises.empty()) return slopes_rad;
  auto above = rises.begin();
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const auto at = rises.begin() +
                    static_cast<std::ptrdiff_t>(shares[i] * static_cast<double>(rises.size() - 1));
    std::nth_element(above, at, rises.end());
    slopes_rad[i] = std::atan(std::sqrt(*at));
    above = at;
  }
  return slopes_rad;
}

/// How many elevation cells have each soil, and at last how many have none.
std::vector<std::size_t> cells_of_soils(const TerrainMap& map) {
  const GridFrame& frame = map.elevation().frame;
  std::vector<std::size_t> cells(map.soils().size() + 1);
  const auto place = [&](const std::optional<int>& soil) {
    return soil ? static_cast<std::size_t>(*soil) : map.soils().size();
  };
  if (!map.classes()) {
    cells[place(map.soil_index(frame.west_m, frame.north_m))] = map.elevation().height_m.size();
    return cells;
  }
  for (int row = 0; row < frame.rows; ++row) {
    const double y_m = frame.north_m - (row + 0.5) * frame.cell_height_m;
    for (int column = 0; column < frame.columns; ++column) {
      ++cells[place(map.soil_index(frame.west_m + (column + 0.5) * frame.cell_width_m, y_m))];
    }
  }
  return cells;
}

}  // namespace

TerrainSummary summarize(const TerrainMap& map) {
  const ElevationRaster& elevation = map.elevation();
  const GridFrame& frame = elevation.frame;
  const double cells = static_cast<double>(elevation.height_m.size());
  TerrainSummary summary;
  summary.frame = frame;

  double known = 0;
  summary.height_min_m = std::numeric_limits<double>::infinity();
  summary.height_max_m = -summary.height_min_m;
  for (const float height : elevation.height_m) {
    if (std::isnan(height)) continue;
    ++known;
    summary.height_min_m = std::min<double>(summary.height_min_m, height);
    summary.height_max_m = std::max<double>(summary.height_max_m, height);
  }
  summary.known_share = known / cells;

  const auto slopes_rad = slope_quantiles_rad(elevation, {0.5, 0.9, 0.99, 1});
  summary.slope_p50_rad = slopes_rad[0];
  summary.slope_p90_rad = slopes_rad[1];
  summary.slope_p99_rad = slopes_rad[2];
  summary.slope_max_rad = slopes_rad[3];

  const std::vector<std::size_t> soil_cells = cells_of_soils(map);
  for (std::size_t i = 0; i < map.soils().size(); ++i) {
    summary.soils.push_back({map.soils()[i].name, static_cast<double>(soil_cells[i]) / cells});
  }
  summary.no_soil_share = static_cast<double>(soil_cells.back()) / cells;

  for (const Rock& rock : map.rocks()) {
    if (!map.inside(rock.x_m, rock.y_m)) continue;
    ++summary.rocks;
    summary.rock_share += std::numbers::pi * rock.radius_m * rock.radius_m /
                          (cells * frame.cell_width_m * frame.cell_height_m);
  }
  return summary;
}

}  // namespace regoplan
