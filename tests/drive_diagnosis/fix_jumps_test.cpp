#include "drive_diagnosis/recording/fix_jumps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "drive_diagnosis/recording/time_checks.h"

namespace regoplan {
namespace {

constexpr double kSpeedMax_mps = 2;

/// Round a circle at 1 m/s, a fix each `step_s` that scatters by 2 cm, standing for a while.
DriveRecording circle(double step_s) {
  DriveRecording drive{.drive_id = "d"};
  std::mt19937_64 random(1);
  std::normal_distribution<double> scatter(0, 0.02);
  double way_m = 0;
  for (int i = 0; i < 120; ++i) {
    const double time_s = i * step_s;
    if (i < 50 || i > 60) way_m += step_s;
    drive.time_s.push_back(time_s);
    drive.x_m.push_back(8 * std::cos(way_m / 8) + scatter(random));
    drive.y_m.push_back(8 * std::sin(way_m / 8) + scatter(random));
  }
  return drive;
}

std::vector<std::size_t> jumps_of(const DriveRecording& drive) {
  std::vector<std::size_t> rows(drive.size());
  std::iota(rows.begin(), rows.end(), 0);
  std::vector<std::size_t> found;
  for (const FixJump& jump : fix_jumps(drive, rows, kSpeedMax_mps)) found.push_back(jump.row);
  return found;
}

using Rows = std::vector<std::size_t>;

TEST(FixJumps, OfAVehicleThatTurnsStopsAndSetsOffNoneIsFound) {
  for (const double step_s : {0.1, 0.2, 1.0, 2.0}) EXPECT_EQ(jumps_of(circle(step_s)), Rows{});
}

TEST(FixJumps, AFixThatGoesOutByMoreThanAMetreAndComesBackIsOne) {
  for (const double step_s : {0.2, 1.0}) {
    for (const std::size_t row : {0U, 1U, 30U, 55U, 118U, 119U}) {
      DriveRecording drive = circle(step_s);
      drive.y_m[row] += row == 30 || row == 55 ? 1.4 : 10;
      EXPECT_EQ(jumps_of(drive), Rows{row}) << step_s << ", " << row;
    }
  }
}

TEST(FixJumps, SomeInARowForASecondAreAndSoAreTwoOfThreeInARow) {
  DriveRecording drive = circle(0.2);
  for (const std::size_t row : {30U, 31U, 32U, 33U, 34U, 80U, 82U}) drive.x_m[row] += 5;
  EXPECT_EQ(jumps_of(drive), (Rows{30, 31, 32, 33, 34, 80, 82}));
}

TEST(FixJumps, WhatStaysAwayIsNone) {
  DriveRecording drive = circle(1);
  for (std::size_t row = 40; row < 70; ++row) drive.x_m[row] += 5;
  EXPECT_EQ(jumps_of(drive), Rows{});
}

TEST(FixJumps, OneIsToldAsAJumpOfItsTimeAndNotAsTwoStepsOfTheDatum) {
  DriveRecording drive = circle(1);
  const DriveRecording sound = drive;
  drive.x_m[30] += 2;
  mend_positions(drive, kSpeedMax_mps);
  ASSERT_EQ(drive.findings.size(), 1U);
  EXPECT_EQ(drive.findings[0].id, "position_jump");
  EXPECT_NE(drive.findings[0].text.find("1 position jumps (by"), std::string::npos);
  EXPECT_NE(drive.findings[0].text.find("at 30.00 s"), std::string::npos);
  EXPECT_TRUE(std::isnan(drive.x_m[30]));
  for (std::size_t row = 0; row < drive.size(); ++row) {
    if (row == 30) continue;
    EXPECT_EQ(drive.x_m[row], sound.x_m[row]);
  }
}

}  // namespace
}  // namespace regoplan
