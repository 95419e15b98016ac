#include "maps/crater_shape.h"

#include <gtest/gtest.h>

#include <cmath>

namespace regoplan {
namespace {

// Pike (1977), simple craters, D in km: depth 0.196 D^1.010, rim height 0.036 D^1.014. The young
// rim is rounded, which takes 4 % of the depth and 16 % of the rim.
TEST(CraterShape, AFreshCraterHasPikesDepthAndRim) {
  const CraterShape shape;
  for (const double diameter_m : {5.0, 20.0, 100.0}) {
    const CraterProfile fresh = shape.profile(diameter_m, CraterShape::kYoungest);
    const double diameter_km = diameter_m / 1000;
    EXPECT_NEAR(fresh.depth_m() / (196 * std::pow(diameter_km, 1.010)), 1, 0.05);
    EXPECT_NEAR(fresh.rim_height_m() / (36 * std::pow(diameter_km, 1.014)), 0.84, 0.04);
  }
}

TEST(CraterShape, CratersOnlyGetShallowerAndLowerWithAge) {
  const CraterShape shape;
  double depth_m = 1e9;
  double rim_m = 1e9;
  for (double age = CraterShape::kYoungest; age <= CraterShape::kOldest; age += 0.01) {
    const CraterProfile profile = shape.profile(20, age);
    EXPECT_LT(profile.depth_m(), depth_m);
    EXPECT_LT(profile.rim_height_m(), rim_m);
    depth_m = profile.depth_m();
    rim_m = profile.rim_height_m();
  }
  EXPECT_NEAR(depth_m / 20, 0.034, 0.003) << "counted as gone";
}

TEST(CraterShape, WearingDownMovesGroundAndLosesNone) {
  const CraterShape shape;
  const auto volume = [&](double age, double reach) {
    const CraterProfile profile = shape.profile(20, age);
    double sum = 0;
    for (double r = 0.0005; r < reach; r += 0.001) sum += profile.height_m(r) * r * 0.001;
    return sum;
  };
  const double bowl = volume(0, 0.9);
  const double fresh = volume(0, CraterProfile::kReach);
  for (const double age : {0.01, 0.1, CraterShape::kOldest}) {
    EXPECT_NEAR((volume(age, CraterProfile::kReach) - fresh) / bowl, 0, 0.02) << age;
  }
}

TEST(CraterShape, EjectaThinOutAsTheInverseCube) {
  const CraterProfile fresh = CraterShape().profile(20, CraterShape::kYoungest);
  EXPECT_NEAR(fresh.height_m(2.4) / fresh.height_m(1.2), std::pow(2, -3), 0.01);
  EXPECT_EQ(fresh.height_m(CraterProfile::kReach), 0);
  EXPECT_EQ(fresh.height_m(100), 0);
}

// No steeper than the angle of repose of dry ground, some 37 degrees.
TEST(CraterShape, NoWallIsSteeperThanTheAngleOfRepose) {
  const CraterProfile fresh = CraterShape().profile(20, CraterShape::kYoungest);
  for (double r = 0; r < CraterProfile::kReach; r += 0.01) {
    const double slope = (fresh.height_m(r + 0.01) - fresh.height_m(r)) / (0.01 * 10);
    EXPECT_LT(std::abs(std::atan(slope)) * 180 / M_PI, 37);
  }
}

}  // namespace
}  // namespace regoplan
