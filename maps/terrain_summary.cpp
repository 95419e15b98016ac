#include "maps/terrain_summary.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

namespace regoplan {

namespace {

std::vector<float> slopes_rad(const ElevationRaster& elevation) {
  const GridFrame& frame = elevation.frame;
  std::vector<float> slopes;
  for (int row = 1; row + 1 < frame.rows; ++row) {
    const float* cell =
        elevation.height_m.data() + static_cast<std::ptrdiff_t>(row) * frame.columns;
    for (int column = 1; column + 1 < frame.columns; ++column) {
      const double along_x = (cell[column + 1] - cell[column - 1]) / (2 * frame.cell_width_m);
      const double along_y =
          (cell[column - frame.columns] - cell[column + frame.columns]) / (2 * frame.cell_height_m);
      const double slope = std::atan(std::hypot(along_x, along_y));
      if (!std::isnan(slope)) slopes.push_back(static_cast<float>(slope));
    }
  }
  return slopes;
}

/// Reorders `values`.
double quantile(std::span<float> values, double share) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, values.begin() + rank);
  return values[static_cast<std::size_t>(rank)];
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

  std::vector<float> slopes = slopes_rad(elevation);
  summary.slope_p50_rad = quantile(slopes, 0.5);
  summary.slope_p90_rad = quantile(slopes, 0.9);
  summary.slope_p99_rad = quantile(slopes, 0.99);
  summary.slope_max_rad = quantile(slopes, 1);

  for (const MapSoil& soil : map.soils()) summary.soils.push_back({soil.name, 0});
  for (int row = 0; row < frame.rows; ++row) {
    for (int column = 0; column < frame.columns; ++column) {
      const std::optional<int> soil =
          map.soil_index(frame.west_m + (column + 0.5) * frame.cell_width_m,
                         frame.north_m - (row + 0.5) * frame.cell_height_m);
      double& share =
          soil ? summary.soils[static_cast<std::size_t>(*soil)].share : summary.no_soil_share;
      share += 1;
    }
  }
  for (TerrainSummary::SoilShare& soil : summary.soils) soil.share /= cells;
  summary.no_soil_share /= cells;

  for (const Rock& rock : map.rocks()) {
    if (!map.inside(rock.x_m, rock.y_m)) continue;
    ++summary.rocks;
    summary.rock_share += std::numbers::pi * rock.radius_m * rock.radius_m /
                          (cells * frame.cell_width_m * frame.cell_height_m);
  }
  return summary;
}

}  // namespace regoplan
