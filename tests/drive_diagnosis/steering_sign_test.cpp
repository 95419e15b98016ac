#include "drive_diagnosis/instruments/steering_sign.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

#include "drive_diagnosis/drive_diagnosis.h"
#include "drive_diagnosis/instruments/rim_sign.h"
#include "terramech/basics/angles.h"
#include "tests/drive_diagnosis/simulated_drive.h"

namespace regoplan {
namespace {

constexpr double kSteeringWindow_s = 5, kSteeringBeyond = 0.3;

DriveRecording rightly_steered() {
  static const DriveRecording drive = record({.seed = 5}, rolling_map());
  return drive;
}

/// Multiplies what is told of the wheels whose names hold a part.
void multiply_steering(DriveRecording& drive, const std::string& part, double factor) {
  for (DriveChannel& channel : drive.channels) {
    const bool is_it = channel.name.starts_with("steer_") || channel.name == "curvature_1pm";
    if (!is_it || channel.name.find(part) == std::string::npos) continue;
    for (float& value : channel.values) value *= static_cast<float>(factor);
  }
}

std::vector<DriveWindow> windows_of_steering(const std::vector<DriveRecording>& drives) {
  std::vector<DriveWindow> windows;
  for (std::size_t i = 0; i < drives.size(); ++i) {
    std::ranges::copy(drive_windows(drives[i], i, kSteeringWindow_s, kSteeringBeyond),
                      std::back_inserter(windows));
  }
  return windows;
}

std::vector<DriveFinding> mended_steering(std::vector<DriveRecording>& drives,
                                          const Vehicle& vehicle = preset_vehicle("lrv")) {
  return mend_steering(drives, windows_of_steering(drives), vehicle);
}

void expect_as_sound(const DriveRecording& drive, const DriveRecording& sound) {
  for (std::size_t k = 0; k < drive.channels.size(); ++k) {
    const std::vector<float>&is = drive.channels[k].values, &was = sound.channels[k].values;
    for (std::size_t i = 0; i < is.size(); ++i) {
      if (std::isnan(was[i])) continue;
      EXPECT_NEAR(is[i], was[i], 1e-5) << drive.channels[k].name;
    }
  }
}

TEST(SteeringSign, OfAllWheelsOfAnAxleOrOfOneWheelIsTakenForWhatItIs) {
  for (const std::string part : {"", "front", "rear_left"}) {
    std::vector<DriveRecording> drives{rightly_steered()};
    multiply_steering(drives[0], part, -1);
    const std::vector<DriveFinding> found = mended_steering(drives);
    ASSERT_EQ(found.size(), 1U) << part;
    EXPECT_EQ(found[0].id, "sign");
    EXPECT_TRUE(found[0].mended);
    EXPECT_EQ(found[0].text.find("front and rear are exchanged") != std::string::npos,
              part.empty());
    expect_as_sound(drives[0], rightly_steered());
  }
}

TEST(SteeringSign, AnglesInAnotherUnitAreConverted) {
  for (const double factor : {kDegree, -kDegree, 1 / kDegree}) {
    std::vector<DriveRecording> drives{rightly_steered()};
    multiply_steering(drives[0], "", factor);
    const std::vector<DriveFinding> found = mended_steering(drives);
    ASSERT_EQ(found.size(), 1U) << factor;
    EXPECT_EQ(found[0].id, "unit");
    expect_as_sound(drives[0], rightly_steered());
  }
}

/// Values by when they were sampled, of a vehicle that moves as it is said to.
struct SaidToMove {
  std::function<double(double time_s)> course_rad, yaw_rad, steer_rad, roll_rad;

  DriveRecording recorded() const {
    DriveRecording drive{.drive_id = "d"};
    DriveChannel yaw{"yaw_rad", {}}, roll{"roll_rad", {}}, steer{"", {}};
    constexpr double kStep_s = 0.2;
    double x_m = 0, y_m = 0;
    for (double t = 0; t < 300; t += kStep_s) {
      drive.time_s.push_back(t);
      drive.x_m.push_back(x_m);
      drive.y_m.push_back(y_m);
      yaw.values.push_back(static_cast<float>(yaw_rad(t)));
      roll.values.push_back(static_cast<float>(roll_rad(t)));
      steer.values.push_back(static_cast<float>(steer_rad(t)));
      x_m += kStep_s * std::cos(course_rad(t));
      y_m += kStep_s * std::sin(course_rad(t));
    }
    drive.channels = {yaw, roll};
    for (const WheelMount& wheel : preset_vehicle("lrv").wheels) {
      steer.name = "steer_" + wheel.name + "_rad";
      drive.channels.push_back(steer);
    }
    return drive;
  }
};

double no_angle(double) {
  return 0;
}
double weaving_angle(double time_s) {
  return 8 * kDegree * std::sin(time_s / 11);
}

TEST(SteeringSign, OfAVehicleThatCrabsIsRight) {
  // Its yaw stays while it goes to the side that both axles are steered to.
  const SaidToMove crab{.course_rad = weaving_angle,
                        .yaw_rad = no_angle,
                        .steer_rad = weaving_angle,
                        .roll_rad = no_angle};
  std::vector<DriveRecording> drives{crab.recorded()};
  EXPECT_TRUE(mended_steering(drives).empty());
  multiply_steering(drives[0], "", -1);
  EXPECT_EQ(mended_steering(drives).size(), 1U);
}

TEST(SteeringSign, OfAVehicleThatSlidesDownASlopeThatItIsSteeredUpIsRight) {
  const auto half_against = [](double time_s) { return -weaving_angle(time_s) / 2; };
  const SaidToMove sliding{.course_rad = weaving_angle,
                           .yaw_rad = no_angle,
                           .steer_rad = half_against,
                           .roll_rad = weaving_angle};
  std::vector<DriveRecording> drives{sliding.recorded()};
  EXPECT_TRUE(mended_steering(drives).empty());
}

TEST(SteeringSign, IsNotDoubtedOfOffsetsNorOfStraightDrivesNorOfVehiclesThatDoNotSteer) {
  for (const double offset_deg : {-2.0, 2.0}) {
    SimulatedDrive drive{.seed = 6};
    drive.deviation.steering_offset_rad[0] = offset_deg * kDegree;
    std::vector<DriveRecording> drives{record(drive, rolling_map())};
    EXPECT_TRUE(mended_steering(drives).empty());
  }
  SimulatedDrive straight{.seed = 7};
  straight.weave_1pm = [](double, double) { return 0.0; };
  std::vector<DriveRecording> drives{record(straight, rolling_map())};
  EXPECT_TRUE(mended_steering(drives).empty());
  Vehicle skid = preset_vehicle("lrv");
  for (WheelMount& wheel : skid.wheels) wheel.steered = false;
  drives = {rightly_steered()};
  multiply_steering(drives[0], "", -1);
  EXPECT_TRUE(mended_steering(drives, skid).empty());
}

TEST(SteeringSign, IsJudgedDriveByDriveAndShortOnesFollow) {
  std::vector<DriveRecording> drives{rightly_steered(), rightly_steered()};
  drives[0].drive_id = "first";
  drives[1].drive_id = "second";
  multiply_steering(drives[1], "", -1);
  std::vector<DriveFinding> found = mended_steering(drives);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].drive, "second");
  multiply_steering(drives[0], "", -1);
  multiply_steering(drives[1], "", -1);
  std::vector<DriveWindow> windows = windows_of_steering(drives);
  std::erase_if(windows, [](const DriveWindow& w) { return w.drive == 1 && w.start_s > 40; });
  found = mend_steering(drives, windows, preset_vehicle("lrv"));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].drive, "");
  expect_as_sound(drives[1], rightly_steered());
}

TEST(SteeringSign, ACurvatureOfTheOtherSignIsTurnedRound) {
  DriveRecording drive = rightly_steered();
  const DriveChannel front = *drive.channel("steer_front_left_rad");
  std::erase_if(drive.channels, [](const DriveChannel& c) { return c.name.starts_with("steer_"); });
  drive.channels.push_back({"curvature_1pm", front.values});
  std::vector<DriveRecording> drives{drive};
  EXPECT_TRUE(mended_steering(drives).empty());
  multiply_steering(drives[0], "", -1);
  ASSERT_EQ(mended_steering(drives).size(), 1U);
  expect_as_sound(drives[0], drive);
}

DriveDiagnosis diagnosed_of_signs(DriveRecording drive) {
  return diagnose_drives(
      {std::move(drive)},
      {.map = rolling_map(), .vehicle = preset_vehicle("lrv"), .gravity_mps2 = 1.62, .window_s = 5},
      {});
}

/// A payload of -83 % had been claimed, 49 standard deviations from nothing.
TEST(SteeringSign, IsAFindingAndNoPayload) {
  DriveRecording drive = rightly_steered();
  multiply_steering(drive, "", -1);
  const DriveDiagnosis diagnosis = diagnosed_of_signs(std::move(drive));
  EXPECT_EQ(diagnosis.verdict, DriveVerdict::kConsistent);
  ASSERT_EQ(diagnosis.findings.size(), 1U);
  EXPECT_EQ(diagnosis.findings[0].id, "sign");
}

TEST(RimSign, OfAllWheelsOrASideOrOneWheelIsAFindingAndNothingIsClaimed) {
  for (const std::string part : {"", "left", "rear_right"}) {
    DriveRecording drive = rightly_steered();
    for (DriveChannel& channel : drive.channels) {
      if (!channel.name.starts_with("wheel_speed_")) continue;
      if (channel.name.find(part) == std::string::npos) continue;
      for (float& value : channel.values) value = -value;
    }
    const DriveDiagnosis diagnosis = diagnosed_of_signs(std::move(drive));
    EXPECT_EQ(diagnosis.verdict, DriveVerdict::kConsistent) << part;
    ASSERT_EQ(diagnosis.findings.size(), 1U) << part << ": " << diagnosis.findings.front().text;
    EXPECT_EQ(diagnosis.findings[0].id, "sign");
  }
}

/// Whose yaw is that of the track of positions, and looks along it as it drives backwards.
TEST(RimSign, OfAVehicleThatDrivesBackwardsIsRight) {
  std::vector<DriveRecording> drives{rightly_steered()};
  const SideGeometry turned_round{.left_wheels = {"front_right", "rear_right"},
                                  .right_wheels = {"front_left", "rear_left"}};
  for (DriveChannel& channel : drives[0].channels) {
    if (!channel.name.starts_with("wheel_speed_")) continue;
    for (float& value : channel.values) value = -value;
  }
  const std::vector<DriveWindow> windows = windows_of_steering(drives);
  EXPECT_TRUE(mend_rim_signs(drives, windows, turned_round).empty());
}

}  // namespace
}  // namespace regoplan
