#pragma once

#include <cstdint>

#include "maps/terrain_map.h"

namespace regoplan {

/// What a synthetic cratered terrain is made of. Same settings, same terrain, bit for bit.
struct SyntheticTerrainSettings {
  std::uint64_t seed = 1;
  double width_m = 200;
  double height_m = 200;
  double cell_m = 0.5;
  double crater_diameter_min_m = 6;
  double crater_diameter_max_m = 60;
  double crater_density_scale = 1;  ///< 1: a lunar mare surface
  double roughness_m = 0.05;        ///< standard deviation of the ground between craters
  double rock_coverage = 0.01;      ///< share of the area covered by rocks
  double rock_diameter_min_m = 0.4;
  double rock_diameter_max_m = 4;
  int soil_zones = 3;  ///< class codes 1 to soil_zones
  double soil_zone_size_m = 50;
};

struct SyntheticTerrain {
  ElevationRaster elevation;
  ClassRaster classes;
  std::vector<Rock> rocks;
};

/// \throws ValueError naming a setting out of its range
SyntheticTerrain make_synthetic_terrain(const SyntheticTerrainSettings& settings);

}  // namespace regoplan
