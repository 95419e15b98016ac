#include "drive_diagnosis/current_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace regoplan {
namespace {

constexpr double kRobotHalfTrack_m = 0.4;

/// What a side takes in a window, by the name of its term.
struct Taken {
  double not_driven, constant, direction, gravity, braking, turn, either_turn;
};

Taken taken(int side, const CurrentWindow& window) {
  const auto [rest, constant, direction, gravity, braking, turn, either] =
      CurrentModel::terms(side, window, kRobotHalfTrack_m);
  return {rest, constant, direction, gravity, braking, turn, either};
}

TEST(CurrentModel, InASpotTurnTheSidesRollAgainstEachOther) {
  const CurrentWindow left_turn{.speed_mps = 0.02, .yaw_rate_rad_s = 0.4};
  EXPECT_NEAR(taken(0, left_turn).direction, -1, 0.02);
  EXPECT_NEAR(taken(1, left_turn).direction, 1, 0.02);
}

TEST(CurrentModel, DryFrictionOfATurnIsFullInATightOneAndSmallInAWideOne) {
  const auto turn_at = [](double speed_mps) {
    return taken(1, {.speed_mps = speed_mps, .yaw_rate_rad_s = 0.4}).turn;
  };
  EXPECT_GT(turn_at(0.02), 0.99);
  EXPECT_LT(turn_at(5), 0.1);
  EXPECT_DOUBLE_EQ(turn_at(-0.5), turn_at(0.5));
}

TEST(CurrentModel, GravityBrakesWhereItDrivesForwardsAsBackwards) {
  EXPECT_LT(taken(0, {.speed_mps = 0.5, .sin_pitch = -0.2}).braking, 0);  // down
  EXPECT_GT(taken(0, {.speed_mps = -0.5, .sin_pitch = 0.2}).braking, 0);  // down, backwards
  EXPECT_EQ(taken(0, {.speed_mps = 0.5, .sin_pitch = 0.2}).braking, 0);   // up
}

TEST(CurrentModel, WhatNothingIsAskedOfIsNotDriven) {
  const Taken carried = taken(0, {.speed_mps = 3, .yaw_rate_rad_s = 0.2, .driven = 0});
  EXPECT_EQ(carried.not_driven, 1);
  EXPECT_EQ(carried.constant, 0);
  EXPECT_EQ(carried.direction, 0);
  EXPECT_EQ(carried.turn, 0);
}

/// 100 s straight on, 60 s of them driven with 5 A on the left and 4 A on the right; then carried
/// off at 3 m/s with nothing commanded.
DriveRecording driven_then_carried(int number) {
  DriveRecording drive{.drive_id = "d" + std::to_string(number)};
  std::vector<float> yaw, pitch, speed, command, turn, left, right, wheels;
  constexpr double kStep_s = 0.1;
  double x_m = 0;
  for (int i = 0; i < 1000; ++i) {
    const bool driven = i < 600;
    const double speed_mps = driven ? 0.5 : 3;
    drive.time_s.push_back(kStep_s * i);
    drive.x_m.push_back(x_m);
    drive.y_m.push_back(0);
    x_m += kStep_s * speed_mps;
    yaw.push_back(0);
    pitch.push_back(static_cast<float>(0.1 * std::sin(0.05 * i)));
    speed.push_back(static_cast<float>(speed_mps));
    command.push_back(driven ? 75.F : 0.F);
    turn.push_back(0);
    wheels.push_back(driven ? 2.F : 0.F);
    left.push_back(driven ? 5.F : 0.1F);
    right.push_back(driven ? 4.F : 0.1F);
  }
  drive.channels = {{"yaw_rad", yaw},
                    {"pitch_rad", pitch},
                    {"speed_mps", speed},
                    {"command_speed", command},
                    {"command_turn", turn},
                    {"wheel_speed_left_rad_s", wheels},
                    {"wheel_speed_right_rad_s", wheels},
                    {"current_left_a", left},
                    {"current_right_a", right}};
  return drive;
}

TEST(DiagnoseCurrents, AVehicleThatIsCarriedOffIsNotTakenForOneThatDrives) {
  std::vector<DriveRecording> drives;
  std::vector<DriveWindow> windows;
  constexpr double kWindow_s = 3;
  for (int i = 0; i < 4; ++i) {
    drives.push_back(driven_then_carried(i));
    for (DriveWindow& window : drive_windows(drives.back(), drives.size() - 1, kWindow_s)) {
      windows.push_back(std::move(window));
    }
  }
  const auto found = diagnose_currents(drives, windows, {}, false, 1);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->model.level_a(0), 5, 0.05);
  EXPECT_NEAR(found->model.level_a(1), 4, 0.05);
  EXPECT_LT(found->held_out.both_rms_a, 0.1);
  EXPECT_GT(found->held_out.both_constant_rms_a, 1);
}

}  // namespace
}  // namespace regoplan
