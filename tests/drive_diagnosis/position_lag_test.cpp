#include "drive_diagnosis/recording/position_lag.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "drive_diagnosis/recording/time_checks.h"

namespace regoplan {
namespace {

constexpr double kSample_s = 0.1;

/// Where a vehicle is that speeds up and slows down along a bend.
struct Way {
  std::vector<double> x_m, y_m, speed_mps;
};

Way way_of(double change_mps) {
  Way way;
  double x = 0, y = 0;
  for (int i = 0; i < 3000; ++i) {
    const double t = i * kSample_s, yaw = 0.5 * std::sin(t / 40);
    const double speed = 1 + change_mps * std::sin(t / 4) * std::cos(t / 11);
    way.x_m.push_back(x += speed * kSample_s * std::cos(yaw));
    way.y_m.push_back(y += speed * kSample_s * std::sin(yaw));
    way.speed_mps.push_back(speed);
  }
  return way;
}

/// Its recording: wheels that slip now more, now less, and fixes that scatter and come late.
DriveRecording recorded(const Way& way, double lag_s, double scatter_m = 0.02) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> scatter(0, scatter_m);
  DriveRecording drive{.drive_id = "d"};
  drive.channels = {{"wheel_speed_left_rad_s", {}}, {"wheel_speed_right_rad_s", {}}};
  const auto late = static_cast<int>(std::lround(lag_s / kSample_s));
  const int last = static_cast<int>(way.x_m.size()) - 1;
  for (int i = 0; i <= last; ++i) {
    const auto fix = static_cast<std::size_t>(std::clamp(i - late, 0, last));
    const double slip = 0.1 + 0.05 * std::sin(i * kSample_s / 15);
    drive.time_s.push_back(i * kSample_s);
    drive.x_m.push_back(way.x_m[fix] + scatter(random));
    drive.y_m.push_back(way.y_m[fix] + scatter(random));
    for (DriveChannel& wheel : drive.channels) {
      wheel.values.push_back(
          static_cast<float>(way.speed_mps[static_cast<std::size_t>(i)] / (0.3 * (1 - slip))));
    }
  }
  return drive;
}

TEST(PositionLag, IsFoundWithinTwoTenthsOfASecond) {
  for (const double lag_s : {-1.5, 0.9, 1.2, 2.5}) {
    const auto found = position_lag_s(recorded(way_of(0.6), lag_s));
    ASSERT_TRUE(found) << lag_s;
    EXPECT_NEAR(*found, lag_s, 0.2);
  }
}

TEST(PositionLag, OfFixesASecondApartIsFoundToo) {
  DriveRecording drive = recorded(way_of(0.6), 1.2);
  for (std::size_t i = 0; i < drive.size(); ++i) {
    if (i % 10 != 0) drive.x_m[i] = drive.y_m[i] = NAN;
  }
  const auto found = position_lag_s(drive);
  ASSERT_TRUE(found);
  EXPECT_NEAR(*found, 1.2, 0.2);
}

TEST(PositionLag, OfFixesWhoseStampsScatterByMillisecondsIsThatOfSteadyOnes) {
  DriveRecording steady = recorded(way_of(0.6), 1.2);
  for (std::size_t i = 0; i < steady.size(); ++i) {
    if (i % 10 != 0) steady.x_m[i] = steady.y_m[i] = NAN;
  }
  DriveRecording scattered = steady;
  for (std::size_t i = 0; i < steady.size(); i += 20) scattered.time_s[i] += 0.002;
  EXPECT_EQ(position_lag_s(scattered), position_lag_s(steady));
}

TEST(PositionLag, LatePositionsAreTakenBackToTheirTimeAndThatIsTold) {
  const Way way = way_of(0.6);
  DriveRecording drive = recorded(way, 1.2);
  mend_position_lag(drive);
  ASSERT_EQ(drive.findings.size(), 1);
  EXPECT_EQ(drive.findings[0].id, "lag");
  EXPECT_TRUE(drive.findings[0].mended);
  EXPECT_NEAR(*drive.findings[0].value, 1.2, 0.2);
  for (std::size_t i = 100; i + 100 < drive.size(); ++i) {
    ASSERT_NEAR(std::hypot(drive.x_m[i] - way.x_m[i], drive.y_m[i] - way.y_m[i]), 0, 0.45) << i;
  }
}

TEST(PositionLag, IsNoneWherePositionsComeInTimeOrFewTenthsOfASecondLate) {
  for (const double lag_s : {0.0, 0.3}) {
    DriveRecording drive = recorded(way_of(0.6), lag_s);
    const std::vector<double> x_m = drive.x_m;
    mend_position_lag(drive);
    EXPECT_TRUE(drive.findings.empty()) << lag_s;
    EXPECT_EQ(drive.x_m, x_m);
  }
}

TEST(PositionLag, IsNotSeenAtASteadySpeedOrByWheelsThatAreHeld) {
  EXPECT_FALSE(position_lag_s(recorded(way_of(0), 1.2)));
  DriveRecording held = recorded(way_of(0.6), 1.2);
  for (DriveChannel& wheel : held.channels) {
    for (std::size_t i = 0; i < held.size(); ++i) wheel.values[i] = wheel.values[i / 50 * 50];
  }
  EXPECT_FALSE(position_lag_s(held));
}

TEST(PositionLag, GapsAndJumpsThatWereTakenOutDoNotHideIt) {
  DriveRecording drive = recorded(way_of(0.6), 1.2);
  for (std::size_t i = 1000; i < drive.size(); ++i) drive.time_s[i] += 40;
  for (std::size_t i = 50; i < drive.size(); i += 300) drive.x_m[i] += 30;
  mend_positions(drive, 3);
  const auto found = position_lag_s(drive);
  ASSERT_TRUE(found);
  EXPECT_NEAR(*found, 1.2, 0.2);
}

TEST(PositionLag, WheelSpeedsThatDropOutForSecondsAreNoLagAndHideNone) {
  for (const double lag_s : {0.0, 1.2}) {
    DriveRecording drive = recorded(way_of(0.6), lag_s);
    for (DriveChannel& wheel : drive.channels) {
      for (std::size_t i = 0; i < drive.size(); ++i) {
        if (i % 400 < 30) wheel.values[i] = NAN;
      }
    }
    const auto found = position_lag_s(drive);
    ASSERT_EQ(found.has_value(), lag_s > 0);
    EXPECT_NEAR(found.value_or(0), lag_s, 0.2);
  }
}

TEST(PositionLag, OfNothingIsNone) {
  EXPECT_FALSE(position_lag_s({}));
  EXPECT_FALSE(position_lag_s(recorded({}, 0)));
}

}  // namespace
}  // namespace regoplan
