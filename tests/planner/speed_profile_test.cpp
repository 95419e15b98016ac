#include "planner/course/speed_profile.h"

#include <gtest/gtest.h>

#include <cmath>

namespace regoplan {
namespace {

TEST(SpeedProfile, FromRestToRestIsATrapezium) {
  const SpeedProfile profile = limited_by_acceleration({{0, 2}, {50, 2}}, 0, 0, 0.5);
  EXPECT_NEAR(profile.at(1).speed_mps, std::sqrt(2 * 0.5 * 1), 1e-9);
  EXPECT_NEAR(profile.at(1).acceleration_mps2, 0.5, 1e-9);
  EXPECT_DOUBLE_EQ(profile.at(25).speed_mps, 2);
  EXPECT_NEAR(profile.at(49).acceleration_mps2, -0.5, 1e-9);
  EXPECT_EQ(profile.at(50).speed_mps, 0);
  // 4 m and 4 s to speed up, 42 m at 2 m/s, 4 s to stop.
  EXPECT_NEAR(profile.duration_s(50), 4 + 21 + 4, 1e-9);
}

TEST(SpeedProfile, NeverAboveWhatIsAskedNorBeyondTheAcceleration) {
  const SpeedProfile profile =
      limited_by_acceleration({{0, 1}, {10, 3}, {10.5, 0.5}, {20, 3}}, 1, 3, 0.3);
  EXPECT_LE(profile.at(10.5).speed_mps, 0.5 + 1e-9);
  for (double s = 0; s <= 20; s += 0.1) {
    EXPECT_LE(std::abs(profile.at(s).acceleration_mps2), 0.3 + 1e-9) << s;
    EXPECT_LE(profile.at(s).speed_mps, 3);
  }
}

TEST(SpeedProfile, SpeedIsLostAndGatheredNowhereHarderThanWhereItIsSaid) {
  const SpeedProfile profile({{0, 1}, {1, 1}, {1.1, 0.9}, {1.4, 0.8}, {1.5, 0.9}, {3, 1}});
  const auto [braking_m, gathering_m] = profile.hardest_m(0.5, 2);
  EXPECT_NEAR(braking_m, 1, 1e-3) << "where it is fastest there";
  EXPECT_NEAR(gathering_m, 1.5, 1e-3);
  for (double s = 0.5; s <= 2; s += 0.01) {
    EXPECT_GE(profile.at(s).acceleration_mps2, profile.at(braking_m).acceleration_mps2) << s;
    EXPECT_LE(profile.at(s).acceleration_mps2, profile.at(gathering_m).acceleration_mps2) << s;
  }
}

TEST(SpeedProfile, AVeryShortWayIsDriven) {
  const SpeedProfile profile = limited_by_acceleration({{0, 2}, {0.15, 2}}, 0, 0, 0.5);
  EXPECT_GT(profile.speed_max_mps(), 0);
  EXPECT_TRUE(std::isfinite(profile.duration_s(0.15)));
}

}  // namespace
}  // namespace regoplan
