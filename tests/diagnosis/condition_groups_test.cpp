#include "diagnosis/recording/condition_groups.h"

#include <gtest/gtest.h>

#include <numeric>

namespace regoplan {
namespace {

std::size_t groups(const Recording& recording) {
  std::vector<std::size_t> all(recording.runs.size());
  std::iota(all.begin(), all.end(), 0);
  return group_conditions(recording, all).size();
}

TEST(ConditionGroups, ReplicatesAgreeWithinAHundredthOfSlipAndHalfADegree) {
  Recording recording;
  recording.runs = {{.load_n = 60, .slip_ratio = 0.3, .slip_angle_rad = 0.1},
                    {.load_n = 61, .slip_ratio = 0.309, .slip_angle_rad = 0.108}};
  EXPECT_EQ(groups(recording), 1);
  recording.runs[1].slip_ratio = 0.312;
  EXPECT_EQ(groups(recording), 2);
  recording.runs[1].slip_ratio = 0.3;
  recording.runs[1].slip_angle_rad = 0.11;
  EXPECT_EQ(groups(recording), 2);
}

TEST(ConditionGroups, PassSpeedAndPositionPartReplicates) {
  for (const auto& part : {WheelConditions{.pass = 2}, WheelConditions{.speed_mps = 0.1},
                           WheelConditions{.position_m = 0.5}}) {
    Recording recording;
    recording.runs = {{.load_n = 60}, {.load_n = 60, .conditions = part}};
    EXPECT_EQ(groups(recording), 2);
  }
}

TEST(ConditionGroups, LoadsThatVaryALittleAreOneLevelAndLoadsSetApartAreTwo) {
  Recording recording;
  recording.runs = {{.load_n = 60}, {.load_n = 62}, {.load_n = 64}, {.load_n = 80}, {.load_n = 82}};
  EXPECT_EQ(groups(recording), 2);
}

TEST(ConditionGroups, AConditionStandsAtTheMeanOfItsRuns) {
  Recording recording;
  recording.runs = {{.load_n = 60, .slip_ratio = 0.30}, {.load_n = 62, .slip_ratio = 0.31}};
  const Condition at = group_conditions(recording, {0, 1}).front();
  EXPECT_DOUBLE_EQ(at.load_n, 61);
  EXPECT_DOUBLE_EQ(at.slip_ratio, 0.305);
}

}  // namespace
}  // namespace regoplan
