#include "drive_diagnosis/instruments/sensor_checks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "drive_diagnosis/recording/drive_windows.h"

namespace regoplan {
namespace {

constexpr double kPi = std::numbers::pi;

/// At 1 m/s through left and right turns of 10 m, sampled at 5 Hz; skid steering.
/// \param reverses what is after 200 s is driven backwards
DriveRecording winding(bool reverses = false, double duration_s = 400) {
  DriveRecording drive{.drive_id = "d"};
  std::vector<float> yaw, speed, left, right, current_left, current_right;
  double x = 0, y = 0, heading = 0.3;
  constexpr double kStep_s = 0.2, kHalfTrack_m = 0.9, kRadius_m = 0.4;
  for (int i = 0; i * kStep_s < duration_s; ++i) {
    const double t = i * kStep_s;
    const double v = reverses && t > 200 ? -1 : 1;
    const double turn = std::fmod(t, 60) < 30 ? 0.1 : -0.1;
    drive.time_s.push_back(t);
    drive.x_m.push_back(x);
    drive.y_m.push_back(y);
    yaw.push_back(static_cast<float>(std::remainder(heading, 2 * kPi)));
    speed.push_back(static_cast<float>(v));
    left.push_back(static_cast<float>((v - turn * kHalfTrack_m) / kRadius_m));
    right.push_back(static_cast<float>((v + turn * kHalfTrack_m) / kRadius_m));
    // The outer side pushes the vehicle round.
    current_left.push_back(static_cast<float>(3 - 10 * turn));
    current_right.push_back(static_cast<float>(3 + 10 * turn));
    x += kStep_s * v * std::cos(heading);
    y += kStep_s * v * std::sin(heading);
    heading += kStep_s * turn;
  }
  drive.channels = {{"yaw_rad", yaw},
                    {"speed_mps", speed},
                    {"wheel_speed_left_rad_s", left},
                    {"wheel_speed_right_rad_s", right},
                    {"current_left_a", current_left},
                    {"current_right_a", current_right}};
  return drive;
}

SensorChecks checked(const DriveRecording& drive) {
  constexpr double kWindow_s = 4;
  return check_sensors({drive}, drive_windows(drive, 0, kWindow_s), {});
}

bool tells(const SensorChecks& checks, const std::string& id) {
  return std::ranges::find(checks.findings, id, &DriveFinding::id) != checks.findings.end();
}

void change(DriveRecording& drive, const std::string& channel, double times, double plus = 0) {
  for (float& value : drive.channel(channel)->values) {
    value = static_cast<float>(times * static_cast<double>(value) + plus);
  }
}

TEST(SensorChecks, AreSilentOnSoundInstrumentsForwardsAndBackwards) {
  for (const bool reverses : {false, true}) {
    const SensorChecks checks = checked(winding(reverses));
    EXPECT_TRUE(checks.findings.empty()) << checks.findings.front().text;
    EXPECT_EQ(checks.yaw_sign, 1);
    EXPECT_EQ(checks.yaw_offset_rad, 0);
    EXPECT_EQ(checks.sensed_speed_per_mps, 1);
    EXPECT_FALSE(checks.wheel_sides_swapped || checks.current_sides_swapped);
  }
}

TEST(SensorChecks, ACompassTurnsTheOtherWayAndLooksElsewhere) {
  DriveRecording drive = winding();
  change(drive, "yaw_rad", -1, kPi / 2);
  const SensorChecks checks = checked(drive);
  EXPECT_EQ(checks.yaw_sign, -1);
  EXPECT_TRUE(tells(checks, "sign"));
  // Minus the compass is the heading less a quarter turn.
  EXPECT_NEAR(checks.yaw_offset_rad, kPi / 2, 0.02);
}

TEST(SensorChecks, AMinuteAndAHalfShowsACompass) {
  DriveRecording drive = winding(false, 90);
  change(drive, "yaw_rad", -1, kPi / 2);
  EXPECT_EQ(checked(drive).yaw_sign, -1);
}

TEST(SensorChecks, FewPairsAreSureWhereTheyLieOnALine) {
  constexpr std::size_t kFew = SensorChecks::kChecked;
  EXPECT_TRUE(is_sure(-1, kFew));
  EXPECT_TRUE(is_sure(0.95, kFew));
  EXPECT_FALSE(is_sure(0.9, kFew));
  EXPECT_FALSE(is_sure(1, kFew - 1));
  EXPECT_TRUE(is_sure(0.5, 100));
  EXPECT_FALSE(is_sure(0.4, 100));
}

TEST(SensorChecks, AYawThatLooksAsideIsPutRightByItsOffset) {
  DriveRecording drive = winding(true);
  change(drive, "yaw_rad", 1, 0.5);
  const SensorChecks checks = checked(drive);
  EXPECT_EQ(checks.yaw_sign, 1);
  EXPECT_NEAR(checks.yaw_offset_rad, -0.5, 0.02);
  EXPECT_TRUE(tells(checks, "yaw_offset"));
}

TEST(SensorChecks, ASpeedInKnotsIsTold) {
  DriveRecording drive = winding();
  change(drive, "speed_mps", 1.9438);
  const SensorChecks checks = checked(drive);
  EXPECT_NEAR(checks.sensed_speed_per_mps, 1.94, 0.02);
  ASSERT_TRUE(tells(checks, "unit"));
  EXPECT_NE(checks.findings.front().text.find("knots"), std::string::npos);
}

TEST(SensorChecks, SwappedSidesAreToldEachForItself) {
  DriveRecording wheels = winding(), currents = winding();
  std::swap(wheels.channel("wheel_speed_left_rad_s")->values,
            wheels.channel("wheel_speed_right_rad_s")->values);
  std::swap(currents.channel("current_left_a")->values,
            currents.channel("current_right_a")->values);
  const SensorChecks of_wheels = checked(wheels), of_currents = checked(currents);
  EXPECT_TRUE(of_wheels.wheel_sides_swapped && !of_wheels.current_sides_swapped);
  EXPECT_TRUE(!of_currents.wheel_sides_swapped && of_currents.current_sides_swapped);
}

TEST(SensorChecks, WheelSpeedsInDegreesASecondAreDoubted) {
  DriveRecording drive = winding();
  change(drive, "wheel_speed_left_rad_s", 180 / kPi);
  change(drive, "wheel_speed_right_rad_s", 180 / kPi);
  EXPECT_TRUE(tells(checked(drive), "unit"));
}

}  // namespace
}  // namespace regoplan
