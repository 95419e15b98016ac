#include "app/demo/hidden_patch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace regoplan {

std::vector<PathPoint> HiddenPatch::corners() const {
  constexpr int kCorners = 16;
  std::vector<PathPoint> corners;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2 * std::numbers::pi * i / kCorners;
    corners.push_back({x_m + radius_m * std::cos(angle), y_m + radius_m * std::sin(angle)});
  }
  return corners;
}

namespace {

/// Of the places of a patch, the share where the map says the soil of its middle.
double share_of_one_soil(const HiddenPatch& patch, const TerrainMap& map) {
  const auto middle = map.soil_index(patch.x_m, patch.y_m);
  int same = 0, all = 0;
  const double step_m = patch.radius_m / 8;
  for (double dx = -patch.radius_m; dx <= patch.radius_m; dx += step_m) {
    for (double dy = -patch.radius_m; dy <= patch.radius_m; dy += step_m) {
      if (std::hypot(dx, dy) > patch.radius_m) continue;
      ++all;
      same += map.soil_index(patch.x_m + dx, patch.y_m + dy) == middle;
    }
  }
  return static_cast<double>(same) / all;
}

}  // namespace

HiddenPatch hidden_patch(const Candidate& path, const TerrainMap& map) {
  const std::size_t count = path.points.size();
  HiddenPatch best;
  double most = -1;
  for (std::size_t i = count / 3; i < std::max(count / 3 + 1, 2 * count / 3); ++i) {
    HiddenPatch patch;
    patch.x_m = path.points[i].x_m;
    patch.y_m = path.points[i].y_m;
    const double share = share_of_one_soil(patch, map);
    if (share <= most) continue;
    most = share;
    best = patch;
  }
  return best;
}

std::string truth_text(const HiddenPatch& patch) {
  std::string corners;
  for (const PathPoint& corner : patch.corners()) {
    corners +=
        fmt::format("{}[{:.2f}, {:.2f}]", corners.empty() ? "" : ", ", corner.x_m, corner.y_m);
  }
  return fmt::format(
      "# What the demo hides from its planner: soils off their means, and a weak patch on its best "
      "path.\n"
      "soils:\n"
      "  firm_regolith: {{friction_angle_deg: {{std: -0.5}}, kphi: {{std: 0.4}}}}\n"
      "  loose_regolith: {{friction_angle_deg: {{std: 0.3}}, kphi: {{std: -0.5}}}}\n"
      "  soft_patch: {{cohesion_pa: {{std: 0.5}}, kphi: {{std: 0.5}}}}\n"
      "zones:\n"
      "  - name: hidden_patch\n"
      "    like: {}\n"
      "    soil: {{friction_angle_deg: {}, cohesion_pa: {}, kc: {}, kphi: {}}}\n"
      "    corners_m: [{}]\n",
      patch.like, patch.friction_angle_deg, patch.cohesion_pa, patch.kc, patch.kphi, corners);
}

}  // namespace regoplan
