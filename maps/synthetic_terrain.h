#pragma once

#include <cstdint>

#include "maps/terrain_map.h"

namespace regoplan {

/// What a synthetic cratered terrain is made of. Same settings, same terrain, bit for bit.
/// Lengths that are no whole number of cells are rounded up to one.
struct SyntheticTerrainSettings {
  std::uint64_t seed = 1;
  double width_m = 200;   ///< of the map, along x
  double height_m = 200;  ///< of the map, along y
  double cell_m = 0.5;
  double crater_diameter_min_m = 3;
  double crater_diameter_max_m = 60;
  double crater_density_scale = 1;  ///< 1: a lunar mare surface in equilibrium
  double roughness_m = 0.05;        ///< standard deviation of the ground between craters
  double rock_coverage = 0.005;     ///< share of the area covered by rocks of these diameters:
  double rock_diameter_min_m = 0.4;
  double rock_diameter_max_m = 4;
  int soil_zones = 3;  ///< class codes from 1, the firmest, to soil_zones, the loosest
  double soil_zone_size_m = 50;
};

/// Map frame with its origin at the south-west corner of the map; no CRS.
struct SyntheticTerrain {
  ElevationRaster elevation;
  ClassRaster classes;
  std::vector<Rock> rocks;
};

inline constexpr int kSoilZonesMax = 100;

/// \throws ValueError naming a setting out of its range
void validate(const SyntheticTerrainSettings& settings);

/// \throws ValueError as `validate` does
SyntheticTerrain make_synthetic_terrain(const SyntheticTerrainSettings& settings);

}  // namespace regoplan
