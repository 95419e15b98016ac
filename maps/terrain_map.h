#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "terramech/soil.h"

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
  std::string crs_wkt;  ///< empty where the file names none

  double east_m() const { return west_m + columns * cell_width_m; }
  double south_m() const { return north_m - rows * cell_height_m; }
  bool operator==(const GridFrame&) const = default;
};

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

/// A rock that stands on the ground: a vertical cylinder.
struct Rock {
  double x_m = 0;
  double y_m = 0;
  double radius_m = 0;
  double height_m = 0;
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
/// and safe from many threads. Map frame: x east, y north, z up, metres.
class TerrainMap {
 public:
  /// \throws InputError where the parts do not fit together (no known cell, no soil, rasters that
  /// do not overlap, class raster without catalogue entry, a rock that is not finite)
  TerrainMap(ElevationRaster elevation, std::optional<ClassRaster> classes, SoilCatalogue soils,
             std::vector<Rock> rocks);

  /// Whether (x, y) lies on the elevation raster, known or not.
  bool inside(double x_m, double y_m) const;

  /// Bilinear between cell centres (constant over the outer half cell); NaN where any of the
  /// cells it needs is unknown or outside.
  double height_m(double x_m, double y_m) const;

  /// Index in `soils()` of the soil at (x, y); nothing where it is unknown or forbidden.
  std::optional<int> soil_index(double x_m, double y_m) const;

  const std::vector<MapSoil>& soils() const { return soils_.soils; }
  const std::vector<Rock>& rocks() const { return rocks_; }
  const ElevationRaster& elevation() const { return elevation_; }
  const std::optional<ClassRaster>& classes() const { return classes_; }
  const SoilCatalogue& catalogue() const { return soils_; }

  /// The same terrain with other soils of the same names and order.
  TerrainMap with_soils(std::vector<MapSoil> soils) const;

 private:
  ElevationRaster elevation_;
  std::optional<ClassRaster> classes_;
  SoilCatalogue soils_;
  std::vector<Rock> rocks_;
  std::vector<std::int16_t> soil_of_cell_;  ///< on the grid of `classes_`; -1 forbidden
};

}  // namespace regoplan
