#pragma once

#include <string>
#include <vector>

#include "maps/terrain_map.h"
#include "planner/course/path_curve.h"
#include "planner/problem/plan_result.h"

namespace regoplan {

/// Ground of the demo that its planner is not told of: a round patch of soil so weak that the
/// vehicle's wheels sink deeper than they may.
struct HiddenPatch {
  double x_m = 0, y_m = 0, radius_m = 15;
  std::string like = "soft_patch";  ///< the soil of the map that it is like, these numbers aside
  double friction_angle_deg = 24, cohesion_pa = 30, kc = 100, kphi = 2.5e4;

  /// Corners of the polygon that it is, counterclockwise.
  std::vector<PathPoint> corners() const;
};

/// On the middle third of a path, where the map says most nearly one soil below the patch: what a
/// drive then tells is of one soil. \pre the path has points
HiddenPatch hidden_patch(const Candidate& path, const TerrainMap& map);

/// The file for `drive --truth`: the patch, and soils half a standard deviation off their means.
std::string truth_text(const HiddenPatch& patch);

}  // namespace regoplan
