#pragma once

#include <string>
#include <vector>

#include "app/settings/soil_settings.h"
#include "maps/raster_files.h"
#include "tests/scratch_folder.h"

namespace regoplan {

/// One soil, as the value of `soils` in a scenario.
inline constexpr const char* kOneSoil =
    "{soils: {mare: {source: assumed, cohesion_pa: 170, friction_angle_deg: 35, kc: 1400, "
    "kphi: 820000, n: 1, a0: 0.4, a1: 0.15, lambda: 0.9, density_kgpm3: 1500, kx0_m: 0.018, "
    "ky0_m: 0.013}}}";

/// 40 m by 40 m of flat ground, a metre a cell, south-west corner at the origin.
inline ElevationRaster flat_elevation() {
  return {.frame = {.columns = 40,
                    .rows = 40,
                    .west_m = 0,
                    .north_m = 40,
                    .cell_width_m = 1,
                    .cell_height_m = 1,
                    .crs_wkt = {}},
          .height_m = std::vector<float>(1600, 0.0F)};
}

/// How it is planned there. The soil is known exactly, so that all draws are alike: twelve are as
/// good as a hundred, and enough for what each soil number counts.
inline constexpr const char* kFlatPlanner = "planner: {iterations: 200, soil_draws: 12}";

/// A scenario that can be planned: an LRV on the flat ground of dem.tif.
inline std::string flat_scenario() {
  return std::string("map:\n  elevation: dem.tif\n  soils: ") + kOneSoil +
         "\n"
         "vehicle: lrv\n"
         "gravity_mps2: 1.62\n"
         "start: {x_m: 10, y_m: 20, heading_deg: 0}\n"
         "goal: {x_m: 30, y_m: 20, radius_m: 3}\n" +
         kFlatPlanner + "\n";
}

/// dem.tif and scenario.yaml in `folder`; returns the latter.
inline std::string write_flat_scenario(const ScratchFolder& folder) {
  write_elevation(flat_elevation(), folder.path("dem.tif"));
  return folder.write("scenario.yaml", flat_scenario());
}

}  // namespace regoplan
