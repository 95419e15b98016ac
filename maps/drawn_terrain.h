#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "maps/synthetic_terrain.h"

namespace regoplan {

/// A crater as measures give it: a parabolic bowl from rim crest to floor, ejecta that fall with
/// the cube of the distance.
struct DrawnCrater {
  double x_m = 0, y_m = 0;
  double diameter_m = 0;  ///< from crest to crest
  double depth_m = 0;     ///< from crest to floor
  double rim_height_m = 0;
};

/// Straight transverse dunes: a third of a wavelength of slip face, the rest windward.
struct DrawnDunes {
  double wavelength_m = 0;
  double height_m = 0;  ///< from trough to crest
  double wind_rad = 0;  ///< where it blows to, from +x toward +y; crests lie across it
};

/// A rectangle of another soil.
struct DrawnZone {
  int code = 0;
  double west_m = 0, east_m = 0, south_m = 0, north_m = 0;
};

/// Equal rocks along a line, both ends included.
struct DrawnRockRow {
  double from_x_m = 0, from_y_m = 0, to_x_m = 0, to_y_m = 0;
  double spacing_m = 0, radius_m = 0, height_m = 0;
};

/// Terrain stated feature by feature, so that a scenario can be a test of one thing. Heights add
/// up; of zones that overlap the last counts. Map frame with its origin at the south-west corner.
struct DrawnTerrain {
  double width_m = 0;   ///< along x
  double height_m = 0;  ///< along y
  double cell_m = 0.5;
  double slope_east_rad = 0;   ///< rise toward +x
  double slope_north_rad = 0;  ///< rise toward +y
  double roughness_m = 0;      ///< amplitude of smooth random ground, 8 m across
  std::uint64_t seed = 1;      ///< of the roughness
  int soil = 1;                ///< class code outside every zone
  std::vector<DrawnCrater> craters = {};
  std::optional<DrawnDunes> dunes = {};
  std::vector<DrawnZone> zones = {};
  std::vector<Rock> rocks = {};
  std::vector<DrawnRockRow> rock_rows = {};
};

/// \throws ValueError naming a setting out of its range
SyntheticTerrain draw_terrain(const DrawnTerrain& drawn);

}  // namespace regoplan
