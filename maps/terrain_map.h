#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "maps/rock_index.h"
#include "terramech/parameters/soil.h"

namespace regoplan {

/// Where the cells of a north-up raster lie. Cell (column, row) has its centre at
/// (west_m + (column + 0.5) cell_width_m, north_m - (row + 0.5) cell_height_m).
struct GridFrame {
  int columns = 0;
  int rows = 0;
  double west_m = 0;
  double north_m = 0;
  double cell_width_m = 0;
  double cell_height_m = 0;
  std::string crs_wkt = {};  ///< empty where the file names none

  double east_m() const { return west_m + columns * cell_width_m; }
  double south_m() const { return north_m - rows * cell_height_m; }
  bool operator==(const GridFrame&) const = default;
};

/// Whether two grids of the same CRS share any area.
bool overlap(const GridFrame& a, const GridFrame& b);

/// Elevations, metres, row by row from the north; NaN where unknown.
struct ElevationRaster {
  GridFrame frame;
  std::vector<float> height_m;
};

/// Soil class codes, row by row from the north; nothing where unmapped.
struct ClassRaster {
  static constexpr std::int32_t kNoData = INT32_MIN;
  GridFrame frame;
  std::vector<std::int32_t> code;
};

/// A soil of a map.
struct MapSoil {
  std::string name;
  std::string source;
  UncertainSoil soil;
};

/// Which soil each class code stands for.
struct SoilCatalogue {
  std::vector<MapSoil> soils;
  /// class code -> index in `soils`; codes not listed are unmapped
  std::vector<std::pair<std::int32_t, int>> classes;
  /// soil of unmapped cells; without one they are forbidden
  std::optional<int> unmapped;
};

/// Terrain that vehicles are planned over: heights, soils and rocks. Immutable; queries are const
/// and safe from many threads; copies share their rasters. Map frame: x east, y north, z up,
/// metres.
class TerrainMap {
 public:
  /// \throws InputError where the parts do not fit together (no known cell, no soil, rasters that
  /// do not overlap, class raster of which no cell has a soil, a rock that is not finite or no rock
  /// on the map, several soils without a class raster)
  TerrainMap(ElevationRaster elevation, std::optional<ClassRaster> classes, SoilCatalogue soils,
             std::vector<Rock> rocks);

  /// Whether (x, y) lies on the elevation raster, edges included, known or not.
  bool inside(double x_m, double y_m) const;

  /// Bilinear between cell centres (constant over the outer half cell); NaN where any of the
  /// cells it needs is unknown or outside.
  double height_m(double x_m, double y_m) const;

  /// The largest elevation of all cells that `height_m` needs anywhere in the rectangle, hence no
  /// less than `height_m` at any point of it; NaN where any of them is unknown or outside.
  double max_height_m(double x_min_m, double x_max_m, double y_min_m, double y_max_m) const;

  /// Index in `soils()` of the soil at (x, y); nothing where it is unknown or forbidden. The class
  /// of the cell that holds the point; outside the class raster, the soil of unmapped cells.
  std::optional<int> soil_index(double x_m, double y_m) const;

  /// Whether `test(rock)` holds for any rock whose bounding square touches the rectangle. Visits
  /// each such rock at most once and stops at the first that passes.
  template <typename Test>
  bool any_rock(double x_min_m, double x_max_m, double y_min_m, double y_max_m, Test test) const {
    return ground_->rocks.any_of(x_min_m, x_max_m, y_min_m, y_max_m, test);
  }

  const std::vector<MapSoil>& soils() const { return soils_.soils; }
  const std::vector<Rock>& rocks() const { return ground_->rocks.rocks(); }
  const ElevationRaster& elevation() const { return ground_->elevation; }
  const std::optional<ClassRaster>& classes() const { return ground_->classes; }
  const SoilCatalogue& catalogue() const { return soils_; }

  /// The same terrain with other soils of the same names and order; shares the rasters.
  /// \throws InputError where names or order differ
  TerrainMap with_soils(std::vector<MapSoil> soils) const;

  /// The same terrain where ground of these soils, named, is forbidden.
  TerrainMap forbidding(const std::vector<std::string>& soils) const;

 private:
  static constexpr std::int16_t kNoSoil = -1;

  struct Ground {
    ElevationRaster elevation;
    std::optional<ClassRaster> classes;
    RockIndex rocks;
    std::vector<std::int16_t> soil_of_cell;  ///< on the grid of `classes`
    std::int16_t soil_elsewhere = kNoSoil;   ///< of unmapped cells and outside `classes`
  };

  std::shared_ptr<const Ground> ground_;
  SoilCatalogue soils_;
};

/// Where a grid lies, in words.
std::string extent_text(const GridFrame& frame);

/// Whether (x, y) lies in the extent of the grid, edges included; false for NaN.
inline bool covers(const GridFrame& frame, double x_m, double y_m) {
  return x_m >= frame.west_m && x_m <= frame.east_m() && y_m >= frame.south_m() &&
         y_m <= frame.north_m;
}

/// The index of the cell that holds (x, y), which must lie in the extent of the grid.
inline std::size_t cell_at(const GridFrame& frame, double x_m, double y_m) {
  const auto column = std::min<std::ptrdiff_t>(
      static_cast<std::ptrdiff_t>((x_m - frame.west_m) / frame.cell_width_m), frame.columns - 1);
  const auto row = std::min<std::ptrdiff_t>(
      static_cast<std::ptrdiff_t>((frame.north_m - y_m) / frame.cell_height_m), frame.rows - 1);
  return static_cast<std::size_t>(row * frame.columns + column);
}

inline bool TerrainMap::inside(double x_m, double y_m) const {
  return covers(ground_->elevation.frame, x_m, y_m);
}

inline double TerrainMap::height_m(double x_m, double y_m) const {
  const GridFrame& frame = ground_->elevation.frame;
  if (!covers(frame, x_m, y_m)) return std::numeric_limits<double>::quiet_NaN();
  const double u = std::clamp((x_m - frame.west_m) / frame.cell_width_m - 0.5, 0.0,
                              static_cast<double>(frame.columns - 1));
  const double v = std::clamp((frame.north_m - y_m) / frame.cell_height_m - 0.5, 0.0,
                              static_cast<double>(frame.rows - 1));
  const auto column = static_cast<std::ptrdiff_t>(u);
  const auto row = static_cast<std::ptrdiff_t>(v);
  const double across = u - static_cast<double>(column);
  const double down = v - static_cast<double>(row);
  // A neighbour of weight zero is not needed: it is neither read past the edge nor, unknown,
  // makes a known height unknown.
  const std::ptrdiff_t east = across > 0 ? 1 : 0;
  const std::ptrdiff_t south = down > 0 ? frame.columns : 0;
  const float* cell = ground_->elevation.height_m.data() + row * frame.columns + column;
  const double northwest = cell[0];
  const double southwest = cell[south];
  const double north = northwest + across * (cell[east] - northwest);
  const double at_south = southwest + across * (cell[south + east] - southwest);
  return north + down * (at_south - north);
}

inline std::optional<int> TerrainMap::soil_index(double x_m, double y_m) const {
  std::int16_t soil = ground_->soil_elsewhere;
  if (ground_->classes && covers(ground_->classes->frame, x_m, y_m)) {
    soil = ground_->soil_of_cell[cell_at(ground_->classes->frame, x_m, y_m)];
  }
  return soil == kNoSoil ? std::nullopt : std::optional<int>(soil);
}

}  // namespace regoplan
