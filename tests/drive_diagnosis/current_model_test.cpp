#include "drive_diagnosis/current_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <string>

#include "drive_diagnosis/drive_diagnosis.h"
#include "tests/drive_diagnosis/simulated_drive.h"

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
  const auto found = diagnose_currents(drives, windows, {}, false).currents;
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->model.level_a(0), 5, 0.05);
  EXPECT_NEAR(found->model.level_a(1), 4, 0.05);
  EXPECT_LT(found->held_out.both_rms_a, 0.1);
  EXPECT_GT(found->held_out.both_constant_rms_a, 1);
}

/// Straight on over changing slopes for a while, the left side with 3 A more; each minute the
/// currents are off by something of their own.
DriveRecording restless(int duration_s, double minute_scatter_a, double gravity_a = 40) {
  constexpr double kStep_s = 0.5, kSpeed_mps = 0.5;
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  DriveRecording drive{.drive_id = "restless"};
  std::vector<float> pitch, speed, left, right;
  double off_a = 0;
  for (int i = 0; i < duration_s / kStep_s; ++i) {
    const double time_s = kStep_s * i, slope = 0.1 * std::sin(time_s / 17);
    if (i % 120 == 0) off_a = minute_scatter_a * normal(random);
    drive.time_s.push_back(time_s);
    drive.x_m.push_back(kSpeed_mps * time_s);
    drive.y_m.push_back(0);
    pitch.push_back(static_cast<float>(slope));
    speed.push_back(static_cast<float>(kSpeed_mps));
    const double even_a = 6 + gravity_a * std::sin(slope);
    left.push_back(static_cast<float>(even_a + 3 + off_a + 0.3 * normal(random)));
    right.push_back(static_cast<float>(even_a - off_a + 0.3 * normal(random)));
  }
  drive.channels = {{"yaw_rad", std::vector<float>(pitch.size(), 0.F)},
                    {"pitch_rad", pitch},
                    {"speed_mps", speed},
                    {"current_left_a", left},
                    {"current_right_a", right}};
  return drive;
}

DriveDiagnosis by_currents_alone(DriveRecording drive) {
  return diagnose_drives(
      {std::move(drive)},
      {.map = rolling_map(), .vehicle = {}, .uncertain = {}, .gravity_mps2 = 1.62}, {});
}

TEST(DiagnoseCurrents, AModelNoBetterThanAConstantIsNoCleanBill) {
  const DriveDiagnosis poor = by_currents_alone(restless(280, 6, 0));
  ASSERT_TRUE(poor.currents);
  EXPECT_EQ(poor.verdict, DriveVerdict::kUndecided);
  EXPECT_EQ(std::ranges::count(poor.findings, "currents_not_predicted", &DriveFinding::id), 1);
  EXPECT_NE(poor.silent.front().why.find("it does no better"), std::string::npos);
  EXPECT_NE(poor.silent.front().drive.find("longer drives over the same"), std::string::npos);
}

TEST(DiagnoseCurrents, AModelThatPredictsWhatIsHeldOutIsCompared) {
  const DriveDiagnosis good = by_currents_alone(restless(280, 0));
  ASSERT_TRUE(good.currents);
  EXPECT_TRUE(good.currents->held_out.beats_constant);
  EXPECT_NE(good.verdict, DriveVerdict::kUndecided);
  EXPECT_NEAR(good.currents->left_excess_a.value, 3, 0.2);
}

/// Of few stretches the interval had lain beside the value, far from what its deviation says.
TEST(DiagnoseCurrents, TheIntervalOfAnExcessIsThatOfItsDeviation) {
  for (const double scatter_a : {0.5, 3.0}) {
    const auto currents = by_currents_alone(restless(280, scatter_a)).currents;
    ASSERT_TRUE(currents);
    const auto [low, high] = currents->left_excess_ci95_a;
    EXPECT_NEAR(std::midpoint(low, high), currents->left_excess_a.value, 1e-9);
    EXPECT_NEAR((high - low) / 2, 2.776 * currents->left_excess_a.std, 1e-3);  // of 5 stretches
    EXPECT_LT(low, 3);
    EXPECT_GT(high, 3);
  }
}

TEST(DiagnoseCurrents, OfTooShortADriveTheWindowsThatLackAreTold) {
  const DriveDiagnosis brief = by_currents_alone(restless(59, 0));
  EXPECT_FALSE(brief.currents);
  EXPECT_EQ(brief.verdict, DriveVerdict::kUndecided);
  EXPECT_EQ(brief.silent.front().why.find("19 windows in 1 parts"), 0u) << brief.silent.front().why;
  EXPECT_NE(brief.silent.back().why.find("no slip is known"), std::string::npos);
}

}  // namespace
}  // namespace regoplan
