#include "app/drive/broken_limits.h"

#include <gtest/gtest.h>

namespace regoplan {
namespace {

/// A row a second, margins at each, one wheel.
DriveResult driven(const std::vector<double>& traction, const std::vector<double>& slip) {
  DriveResult result{.reached = true};
  for (std::size_t i = 0; i < traction.size(); ++i) {
    DriveMoment moment{.time_s = static_cast<double>(i)};
    moment.state.x_m = static_cast<double>(i);
    moment.wheels = {{.slip = slip[i]}};
    result.moments.push_back(moment);
    result.margins.push_back(
        {.time_s = static_cast<double>(i), .cornering = 1, .tip_over = 1, .traction = traction[i]});
  }
  return result;
}

constexpr Limits kLimits{.margin_min = 0.05,
                         .slip_max = 0.6,
                         .slip_angle_max_rad = 1,
                         .slope_max_rad = 1,
                         .sinkage_max_m = 1};

TEST(BrokenLimits, OfEachStretchTheWorstRowIsMarked) {
  const auto marks = broken_limits_json(
      kLimits, driven({0.2, 0.04, 0.01, 0.03, 0.2, 0.02, 0.2}, {0, 0, 0, 0, 0, 0, 0}));
  ASSERT_EQ(marks.size(), 2);
  EXPECT_EQ(marks[0].at("reason"), "traction");
  EXPECT_EQ(marks[0].at("value"), 0.01);
  EXPECT_EQ(marks[0].at("limit"), 0.05);
  EXPECT_EQ(marks[0].at("x_m"), 2);
  EXPECT_EQ(marks[1].at("value"), 0.02);
  EXPECT_EQ(marks[1].at("x_m"), 5);
}

TEST(BrokenLimits, OfStrainTheLargestByMagnitudeIsMarkedWithItsSign) {
  const auto marks = broken_limits_json(kLimits, driven({1, 1, 1, 1}, {0.1, -0.7, -0.9, -0.65}));
  ASSERT_EQ(marks.size(), 1);
  EXPECT_EQ(marks[0].at("reason"), "slip");
  EXPECT_EQ(marks[0].at("value"), -0.9);
  EXPECT_EQ(marks[0].at("x_m"), 2);
}

TEST(BrokenLimits, OfADriveWithinThemNothingIsMarked) {
  EXPECT_TRUE(broken_limits_json(kLimits, driven({0.06, 0.5}, {0.59, -0.59})).empty());
}

}  // namespace
}  // namespace regoplan
