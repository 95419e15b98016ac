#pragma once

#include <maps/maps.h>
#include <planner/planner.h>

#include "regolith.h"

/// Level ground of one soil, known to within 30 Pa of cohesion: 60 m by 60 m in cells of 0.5 m.
inline regoplan::TerrainMap level_map() {
  constexpr int kCells = 120;
  regoplan::ElevationRaster raster;
  raster.frame.columns = raster.frame.rows = kCells;
  raster.frame.cell_width_m = raster.frame.cell_height_m = 0.5;
  raster.frame.north_m = 60;
  raster.height_m.assign(kCells * kCells, 0.F);
  regoplan::SoilCatalogue soils{
      .soils = {{.name = "regolith",
                 .source = "example",
                 .soil = {.mean = firm_regolith(), .standard_deviation = {.cohesion_pa = 30}}}},
      .classes = {},
      .unmapped = 0};
  return {std::move(raster), std::nullopt, std::move(soils), {}};
}

/// An LRV on the Moon that is to drive 30 m straight on.
inline regoplan::PlanningProblem thirty_metres() {
  const regoplan::Vehicle lrv = regoplan::preset_vehicle("lrv");
  return {.map = level_map(),
          .vehicle = lrv,
          .gravity_mps2 = 1.62,
          .start = {.x_m = 10, .y_m = 25},
          .goal = {.x_m = 40, .y_m = 25, .radius_m = 3, .heading_rad = {}},
          .speed_max_mps = 3,
          .limits = regoplan::default_limits(lrv),
          .search = {.planner = "Lattice",
                     .time_s = {},
                     .iterations = 2000,
                     .candidates = 1,
                     .soil_draws = 20}};
}
