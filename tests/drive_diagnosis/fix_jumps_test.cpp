// Fixes that leave the track and come back to it.
#include "drive_diagnosis/recording/fix_jumps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace regoplan {
namespace {

constexpr double kSpeedMax_mps = 2;

/// Goes off, turns with a radius of 4 m, brakes and stands, its fixes scattered by some
/// centimetres.
DriveRecording driven(std::uint64_t seed, double step_s, double scatter_m = 0.02) {
  DriveRecording drive{.drive_id = "d", .file = "d.csv"};
  std::mt19937_64 random(seed);
  std::normal_distribution<double> off(0, scatter_m);
  double x_m = 0, y_m = 0, yaw_rad = 0;
  for (double time_s = 0; time_s < 60; time_s += step_s) {
    const double speed_mps = std::clamp(std::min(time_s, 50 - time_s), 0.0, 1.5);
    yaw_rad += time_s > 20 && time_s < 30 ? speed_mps / 4 * step_s : 0;
    x_m += speed_mps * std::cos(yaw_rad) * step_s;
    y_m += speed_mps * std::sin(yaw_rad) * step_s;
    drive.time_s.push_back(time_s);
    drive.x_m.push_back(x_m + off(random));
    drive.y_m.push_back(y_m + off(random));
  }
  return drive;
}

std::vector<std::size_t> jumping_rows(const DriveRecording& drive) {
  std::vector<std::size_t> rows(drive.size()), jumping;
  std::iota(rows.begin(), rows.end(), 0);
  for (const FixJump& jump : fix_jumps(drive, rows, kSpeedMax_mps)) jumping.push_back(jump.row);
  return jumping;
}

TEST(FixJumps, OfASoundTrackThereAreNone) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    for (const double step_s : {0.1, 0.2, 1.0}) {
      EXPECT_TRUE(jumping_rows(driven(seed, step_s)).empty()) << seed << " " << step_s;
    }
  }
}

TEST(FixJumps, AreThoseThatComeBackAndNoOthers) {
  DriveRecording drive = driven(4, 0.1);
  for (const std::size_t row : {100, 250, 251, 400}) drive.y_m[row] += 1.5;
  EXPECT_EQ(jumping_rows(drive), (std::vector<std::size_t>{100, 250, 251, 400}));
}

TEST(FixJumps, AStepAfterWhichPositionsStayIsNone) {
  DriveRecording drive = driven(5, 0.1);
  for (std::size_t row = 300; row < drive.size(); ++row) drive.x_m[row] += 5;
  EXPECT_TRUE(jumping_rows(drive).empty());
}

}  // namespace
}  // namespace regoplan
