#pragma once

#include <cmath>
#include <functional>
#include <numbers>

#include "examples/regolith.h"
#include "planner/problem/planning_problem.h"

namespace regoplan {

inline constexpr double kTestDegree = std::numbers::pi / 180;

/// The examples' soil, known exactly.
inline UncertainSoil firm_regolith() {
  return {.mean = ::firm_regolith()};
}

/// A map of `size_m` by `size_m` metres, one soil everywhere.
inline TerrainMap one_soil_map(double size_m, const UncertainSoil& soil,
                               const std::function<double(double x_m, double y_m)>& height_m,
                               std::vector<Rock> rocks = {}, double cell_m = 0.5) {
  const int cells = static_cast<int>(std::lround(size_m / cell_m));
  ElevationRaster raster{.frame = {.columns = cells,
                                   .rows = cells,
                                   .west_m = 0,
                                   .north_m = size_m,
                                   .cell_width_m = cell_m,
                                   .cell_height_m = cell_m,
                                   .crs_wkt = {}},
                         .height_m = {}};
  for (int row = 0; row < cells; ++row) {
    for (int column = 0; column < cells; ++column) {
      raster.height_m.push_back(
          static_cast<float>(height_m((column + 0.5) * cell_m, size_m - (row + 0.5) * cell_m)));
    }
  }
  SoilCatalogue soils{.soils = {{.name = "regolith", .source = "test", .soil = soil}},
                      .classes = {},
                      .unmapped = 0};
  return {std::move(raster), std::nullopt, std::move(soils), std::move(rocks)};
}

inline double flat(double /*x_m*/, double /*y_m*/) {
  return 0;
}

/// An LRV on the Moon, 30 m straight ahead on the given map; one path, by iterations.
inline PlanningProblem lrv_problem(TerrainMap map) {
  const Vehicle lrv = preset_vehicle("lrv");
  return {.map = std::move(map),
          .vehicle = lrv,
          .gravity_mps2 = 1.62,
          .start = {.x_m = 10, .y_m = 25},
          .goal = {.x_m = 40, .y_m = 25, .radius_m = 3, .heading_rad = {}},
          .speed_max_mps = 3,
          .limits = default_limits(lrv),
          .search = {.planner = "RRT",
                     .time_s = {},
                     .iterations = 2000,
                     .seed = 7,
                     .candidates = 1,
                     .soil_draws = 5,
                     .threads = 2}};
}

}  // namespace regoplan
