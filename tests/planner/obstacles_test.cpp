#include "planner/obstacles.h"

#include <gtest/gtest.h>

#include "maps/ground_finder.h"
#include "tests/planner/flat_problem.h"

namespace regoplan {
namespace {

bool hits(const TerrainMap& map, double x_m, double y_m, double yaw_rad = 0,
          double clearance_m = 0) {
  const Vehicle lrv = preset_vehicle("lrv");
  const GroundPatch patch = GroundFinder(map, lrv).at(x_m, y_m, yaw_rad);
  return Obstacles(map, lrv, clearance_m).hit(x_m, y_m, yaw_rad, patch);
}

TerrainMap with_rock(const Rock& rock) {
  return one_soil_map(50, firm_regolith(), flat, {rock});
}

}  // namespace

TEST(Obstacles, OpenGroundIsFree) {
  EXPECT_FALSE(hits(one_soil_map(50, firm_regolith(), flat), 25, 25));
}

TEST(Obstacles, RocksNoHigherThanAStepAreDrivenOver) {
  const double step_m = preset_vehicle("lrv").step_max_m;
  EXPECT_FALSE(hits(with_rock({25, 25, 0.3, step_m}), 25, 25));
  EXPECT_FALSE(hits(with_rock({26.1, 25.9, 0.3, step_m}), 25, 25));
}

TEST(Obstacles, AHigherRockStopsAWheelThatWouldClimbIt) {
  const Vehicle lrv = preset_vehicle("lrv");
  const double x = 25 + lrv.wheels[0].x_m, y = 25 + lrv.wheels[0].y_m;
  EXPECT_TRUE(hits(with_rock({x, y, 0.2, lrv.step_max_m + 0.02}), 25, 25));
}

TEST(Obstacles, ARockLowerThanTheBodyPassesBetweenTheWheels) {
  const double clearance_m = preset_vehicle("lrv").body.clearance_m;
  EXPECT_FALSE(hits(with_rock({25, 25, 0.2, clearance_m - 0.02}), 25, 25));
  EXPECT_TRUE(hits(with_rock({25, 25, 0.2, clearance_m + 0.02}), 25, 25));
}

TEST(Obstacles, ARockBesideTheVehicleIsHitOnlyByAWiderOne) {
  const double edge_m = 25 + preset_vehicle("lrv").body.y_max_m;
  const TerrainMap map = with_rock({25, edge_m + 0.55, 0.5, 1});
  EXPECT_FALSE(hits(map, 25, 25));
  EXPECT_TRUE(hits(map, 25, 25, 0, 0.1));
}

TEST(Obstacles, TheReserveOfASearchReachesDownwardsToo) {
  const double clearance_m = preset_vehicle("lrv").body.clearance_m;
  const TerrainMap map = with_rock({25, 25, 0.2, clearance_m - 0.02});
  EXPECT_FALSE(hits(map, 25, 25));
  EXPECT_TRUE(hits(map, 25, 25, 0, 0.1));
}

TEST(Obstacles, ACylinderIsMetWhereItStandsOnItsSlope) {
  const TerrainMap map = one_soil_map(
      50, firm_regolith(), [](double x, double /*y*/) { return 0.3 * x; }, {{27, 25, 0.3, 1}});
  EXPECT_TRUE(hits(map, 26, 25));
  EXPECT_FALSE(hits(map, 22, 25));
}

TEST(Obstacles, ARidgeHigherThanTheClearanceTouchesTheBodyFromBelow) {
  // A wall half a metre wide, between the axles.
  const auto ridge = [](double height) {
    return [height](double x, double /*y*/) { return std::abs(x - 25) < 0.3 ? height : 0.0; };
  };
  EXPECT_FALSE(hits(one_soil_map(50, firm_regolith(), ridge(0.3)), 25, 25));
  EXPECT_TRUE(hits(one_soil_map(50, firm_regolith(), ridge(0.5)), 25, 25));
}

TEST(Obstacles, HeadingDecidesWhatIsTouched) {
  const double beyond_side_m = 1.3;  // beyond the body's half width, within its half length
  const TerrainMap map = with_rock({25, 25 + beyond_side_m, 0.1, 1});
  EXPECT_FALSE(hits(map, 25, 25, 0));
  EXPECT_TRUE(hits(map, 25, 25, 90 * kTestDegree));
}

}  // namespace regoplan
