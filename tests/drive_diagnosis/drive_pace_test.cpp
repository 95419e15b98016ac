#include "drive_diagnosis/recording/drive_pace.h"

#include <gtest/gtest.h>

#include <random>

#include "drive_diagnosis/recording/drive_windows.h"
#include "drive_diagnosis/recording/time_checks.h"

namespace regoplan {
namespace {

/// Goes straight on, pose at 1 Hz within 2 cm, but stands in the middle half of the time.
DriveRecording with_a_stop(double speed_mps, double way_m) {
  DriveRecording drive{.drive_id = "d", .file = "d.csv"};
  std::mt19937_64 random(1);
  std::normal_distribution<double> scatter_m(0, 0.02);
  const double moving_s = way_m / speed_mps;
  for (double time_s = 0; time_s < 2 * moving_s; ++time_s) {
    const double gone_s = std::min(time_s, moving_s / 2) + std::max(0.0, time_s - 1.5 * moving_s);
    drive.time_s.push_back(time_s);
    drive.x_m.push_back(speed_mps * gone_s + scatter_m(random));
    drive.y_m.push_back(scatter_m(random));
  }
  return drive;
}

TEST(DrivePace, TheUsualSpeedIsThatOfTheWayWhateverStopsThereAre) {
  for (const double speed_mps : {0.01, 0.04, 0.5, 2.0}) {
    const DrivenWay way = driven_way(with_a_stop(speed_mps, 60));
    EXPECT_NEAR(*way.usual_speed_mps, speed_mps, 0.1 * speed_mps);
    EXPECT_NEAR(way.way_m, 60, 2.5);
  }
}

TEST(DrivePace, AParkedVehicleGoesNoWay) {
  EXPECT_FALSE(driven_way(with_a_stop(1e-6, 1e-3)).usual_speed_mps);
  EXPECT_EQ(pace_of(with_a_stop(1e-6, 1e-3)), 1);
}

TEST(DrivePace, FastDrivesAreJudgedByTheSameSpeedsAndInTheSameWindows) {
  for (const double speed_mps : {0.5, 2.0}) {
    const DriveRecording drive = with_a_stop(speed_mps, 2000);
    EXPECT_EQ(pace_of(drive), 1);
    EXPECT_EQ(window_lengths_s({drive}, 5), std::vector<double>{5});
  }
}

TEST(DrivePace, WindowsOfASlowDriveAreAMetreLongOrAsLongAsAllAreCompared) {
  EXPECT_NEAR(pace_of(with_a_stop(0.04, 60)), 0.1, 0.01);
  EXPECT_NEAR(window_lengths_s({with_a_stop(0.04, 60)}, 5)[0], 25, 2.5);
  const DriveRecording far = with_a_stop(0.04, 285);
  EXPECT_NEAR(window_lengths_s({far}, 5)[0], 50, 5);
  const DriveRecording farthest = with_a_stop(0.04, 2000);
  EXPECT_NEAR(window_lengths_s({farthest}, 5)[0], 100, 10);
}

TEST(DrivePace, AJumpThatIsSmallForAFastVehicleIsTakenOutOfASlowDrive) {
  DriveRecording slow = with_a_stop(0.04, 60);
  slow.x_m[100] += 0.45;
  DriveRecording fast = slow;
  mend_positions(slow, 0.01);
  EXPECT_TRUE(std::isnan(slow.x_m[100]));
  mend_positions(fast, 3);
  EXPECT_FALSE(std::isnan(fast.x_m[100]));
}

}  // namespace
}  // namespace regoplan
