#include "app/demo/hidden_patch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "app/demo/demo_scenario.h"
#include "app/settings/truth_settings.h"

namespace regoplan {
namespace {

/// A path from corner to corner of the demo's map.
Candidate diagonal() {
  Candidate path;
  for (int i = 0; i <= 320; ++i) path.points.push_back({.x_m = 20 + i * 0.5, .y_m = 20 + i * 0.5});
  return path;
}

TEST(HiddenPatch, LiesOnTheMiddleThirdOfThePath) {
  const HiddenPatch patch = hidden_patch(diagonal(), demo_problem({}).map);
  EXPECT_EQ(patch.x_m, patch.y_m);
  EXPECT_GE(patch.x_m, 20 + 160 / 3.0 - 0.5);
  EXPECT_LE(patch.x_m, 20 + 160 * 2 / 3.0);
}

TEST(HiddenPatch, ItsTruthIsASoilFarWeakerThanAnyOfTheMap) {
  const PlanningProblem problem = demo_problem({});
  const HiddenPatch patch = hidden_patch(diagonal(), problem.map);
  const DriveTruth truth = parse_truth(truth_text(patch), "truth.yaml", problem);
  ASSERT_EQ(truth.zones.size(), 1u);
  for (const PathPoint& corner : truth.zones[0].corners) {
    EXPECT_NEAR(std::hypot(corner.x_m - patch.x_m, corner.y_m - patch.y_m), patch.radius_m, 0.02);
  }
  for (const MapSoil& soil : problem.map.soils()) {
    EXPECT_LT(truth.zones[0].soil.kphi, soil.soil.mean.kphi / 4) << soil.name;
  }
}

}  // namespace
}  // namespace regoplan
