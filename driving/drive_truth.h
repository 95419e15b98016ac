#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "maps/terrain_map.h"
#include "planner/course/path_curve.h"
#include "terramech/mechanisms/mechanism.h"
#include "terramech/parameters/soil.h"

namespace regoplan {

/// A soil in part of the map, wherever the map's classes say otherwise.
struct SoilZone {
  std::string name;
  Soil soil;
  std::vector<PathPoint> corners;  ///< of a polygon, even-odd; at least three
};

/// Zones as a raster: cells of a code are of its soil, all others as the map has them.
struct ZoneRaster {
  ClassRaster classes;
  std::vector<std::pair<std::int32_t, Soil>> soils;  ///< by code
};

/// A mechanism that acts on some wheels, or on all where none is named.
struct TrueMechanism {
  Mechanism mechanism;
  std::vector<std::string> wheels = {};
};

/// What is wrong with one wheel.
struct WheelFault {
  double drag_nm = 0;                ///< that its motor has to overcome beside the soil, at least 0
  double steer_offset_rad = 0;       ///< beyond what is commanded, left positive
  double radius_factor = 1;          ///< true radius over the known one
  double motor_constant_factor = 1;  ///< torque that is measured over the true one
};

/// How the world driven in differs from the one planned for. As it stands: not at all.
struct DriveTruth {
  /// In the order of the map's soils; empty: their means.
  std::vector<Soil> soils = {};
  std::vector<SoilZone> zones = {};  ///< the first that holds a place counts
  std::optional<ZoneRaster> zone_raster = {};
  std::vector<TrueMechanism> mechanisms = {};
  std::vector<WheelFault> wheels = {};  ///< in the vehicle's order; empty: none
  double payload_kg = 0;                ///< at the centre of gravity; negative: lighter
  double cg_forward_m = 0, cg_left_m = 0, cg_up_m = 0;  ///< off the known centre of gravity
  /// What the map shows at a place lies so much farther east and north.
  double map_east_m = 0, map_north_m = 0;
  /// The borders of its soils besides.
  double soil_east_m = 0, soil_north_m = 0;
  /// Share by which a wheel in the rut of others finds its soil stiffer, of what many passes do:
  /// `multi_pass`, form `stiffening`; nothing: every wheel on fresh ground.
  std::optional<double> rut_stiffness = {};
};

}  // namespace regoplan
