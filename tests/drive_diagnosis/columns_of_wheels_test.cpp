// What columns of wheels are called and in what unit changes nothing that is found.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "drive_diagnosis/comparison/swapped_sides.h"
#include "drive_diagnosis/drive_diagnosis.h"
#include "drive_diagnosis/instruments/rim_holes.h"
#include "drive_diagnosis/instruments/stuck_rims.h"
#include "tests/drive_diagnosis/simulated_drive.h"

namespace regoplan {
namespace {

DriveRecording sound_drive() {
  return record({.seed = 5}, rolling_map());
}

DriveDiagnosis diagnosed(DriveRecording drive, const UncertainVehicle& uncertain = {}) {
  const DriveSetup setup{.map = rolling_map(),
                         .vehicle = preset_vehicle("lrv"),
                         .uncertain = uncertain,
                         .gravity_mps2 = 1.62,
                         .window_s = 5};
  return diagnose_drives({std::move(drive)}, setup, {.seed = 7});
}

const UncertainVehicle kFourNewtonMetresAnAmpere{.motor_constant = DriveEstimate{4, 0.04}};

TEST(ColumnsOfWheels, OfAWheelThatTheVehicleDoesNotHaveAreTold) {
  DriveRecording drive = sound_drive();
  for (DriveChannel& channel : drive.channels) {
    if (channel.name == "torque_front_left_nm") channel.name = "torque_fl_nm";
  }
  const DriveDiagnosis diagnosis = diagnosed(std::move(drive));
  const auto told = std::ranges::find(diagnosis.findings, "unknown_wheel", &DriveFinding::id);
  ASSERT_NE(told, diagnosis.findings.end());
  EXPECT_EQ(told->text,
            "columns of fl are not used: the vehicle's wheels are front_left, front_right, "
            "rear_left, rear_right");
  const std::vector<DriveFinding> of_sound = diagnosed(sound_drive()).findings;
  EXPECT_EQ(std::ranges::count(of_sound, "unknown_wheel", &DriveFinding::id), 0);
}

TEST(ColumnsOfWheels, CurrentsSayWhatTorquesSay) {
  DriveRecording drive = sound_drive();
  for (DriveChannel& channel : drive.channels) {
    if (!channel.name.starts_with("torque_")) continue;
    const std::string wheel = channel.name.substr(7, channel.name.size() - 7 - 3);
    channel.name = "current_" + wheel + "_a";
    for (float& value : channel.values) value /= 4;
  }
  const DriveDiagnosis of_torques = diagnosed(sound_drive()),
                       of_currents = diagnosed(std::move(drive), kFourNewtonMetresAnAmpere);
  ASSERT_TRUE(of_torques.effects && of_currents.effects);
  EXPECT_EQ(of_currents.effects->channels, of_torques.effects->channels);
  for (std::size_t k = 0; k < of_torques.effects->rms.size(); ++k) {
    EXPECT_NEAR(of_currents.effects->rms[k], of_torques.effects->rms[k],
                1e-4 * of_torques.effects->rms[k]);
  }
  EXPECT_TRUE(of_currents.claims.empty());
}

TEST(ColumnsOfWheels, TorquesToldInAnotherUnitAreMultiplied) {
  DriveRecording drive = sound_drive();
  for (DriveChannel& channel : drive.channels) {
    if (!channel.name.starts_with("torque_")) continue;
    for (float& value : channel.values) value /= 4;
  }
  EXPECT_TRUE(diagnosed(std::move(drive), kFourNewtonMetresAnAmpere).claims.empty());
}

TEST(ColumnsOfWheels, RimSpeedsInTurnsAMinuteOrDegreesASecondAreTakenForWhatTheyAre) {
  for (const double per_rad_s : {9.549297, 57.29578}) {
    DriveRecording drive = sound_drive();
    for (DriveChannel& channel : drive.channels) {
      if (!channel.name.starts_with("wheel_speed_")) continue;
      for (float& value : channel.values) value *= static_cast<float>(per_rad_s);
    }
    const DriveDiagnosis found = diagnosed(std::move(drive));
    const auto told = std::ranges::find(found.findings, "unit", &DriveFinding::id);
    ASSERT_NE(told, found.findings.end());
    EXPECT_TRUE(told->mended);
    EXPECT_NEAR(told->value.value(), per_rad_s, 1e-4);
    EXPECT_TRUE(found.claims.empty());
  }
}

TEST(ColumnsOfWheels, ARimSpeedThatSticksIsLeftOutWhileOthersChange) {
  constexpr std::size_t kFrom = 500, kTo = 900;
  std::vector<DriveRecording> drives{sound_drive()};
  std::vector<float>& stuck = drives[0].channel("wheel_speed_rear_right_rad_s")->values;
  std::fill(stuck.begin() + kFrom, stuck.begin() + kTo, stuck[kFrom]);
  const std::vector<DriveFinding> findings = leave_stuck_rims_out(drives);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].id, "stuck");
  const std::vector<float>& left = drives[0].channel("wheel_speed_rear_right_rad_s")->values;
  for (std::size_t i = 0; i < left.size(); ++i) {
    EXPECT_EQ(std::isnan(left[i]), i >= kFrom && i < kTo) << i;
  }
}

TEST(ColumnsOfWheels, WhereAWheelTellsNothingNothingIsComparedAndTheHoleIsTold) {
  DriveRecording drive = sound_drive();
  EXPECT_TRUE(rim_holes({drive}).empty());
  const DriveDiagnosis sound = diagnosed(drive);
  std::vector<float>& rim = drive.channel("wheel_speed_rear_right_rad_s")->values;
  const std::size_t from = 500, to = from + static_cast<std::size_t>(std::ranges::count_if(
                                                drive.time_s, [&](double time_s) {
                                                  return time_s >= drive.time_s[from] &&
                                                         time_s < drive.time_s[from] + 8;
                                                }));
  for (std::size_t i = from; i < to; ++i) rim[i] = std::numeric_limits<float>::quiet_NaN();
  const DriveDiagnosis found = diagnosed(drive);
  EXPECT_EQ(std::ranges::count(found.findings, "hole", &DriveFinding::id), 1);
  EXPECT_TRUE(found.claims.empty());
  // Windows of 5 s: at least one lies within the hole of 8 s or over an end of it.
  EXPECT_LT(found.windows_used->compared, sound.windows_used->compared);
  EXPECT_GE(found.windows_used->compared, sound.windows_used->compared - 4);
}

TEST(ColumnsOfWheels, SpeedsThatAllStandStillAtOnceAreNotStuck) {
  std::vector<DriveRecording> drives{sound_drive()};
  for (DriveChannel& channel : drives[0].channels) {
    if (channel.name.starts_with("wheel_speed_")) {
      std::fill(channel.values.begin() + 500, channel.values.begin() + 900, 3.0F);
    }
  }
  EXPECT_TRUE(leave_stuck_rims_out(drives).empty());
}

TEST(ColumnsOfWheels, OnAMapOfOtherGroundNothingIsClaimedAndTheSlopesAreTold) {
  const DriveSetup setup{.map = map_of_heights([](int, int) { return 0.0; }),
                         .vehicle = preset_vehicle("lrv"),
                         .gravity_mps2 = 1.62,
                         .window_s = 5};
  const DriveDiagnosis found = diagnose_drives({sound_drive()}, setup, {.seed = 7});
  EXPECT_TRUE(found.claims.empty());
  EXPECT_EQ(found.verdict, DriveVerdict::kUndecided);
  EXPECT_EQ(std::ranges::count(found.findings, "map_slopes", &DriveFinding::id), 1);
  EXPECT_EQ(std::ranges::count(diagnosed(sound_drive()).findings, "map_slopes", &DriveFinding::id),
            0);
}

/// A sound drive whose columns of the sides were swapped.
DriveRecording swapped(bool torques, const std::vector<WheelPair>& pairs) {
  std::vector<DriveRecording> drives{sound_drive()};
  exchange("wheel_speed", pairs, drives);
  if (torques) exchange("torque", pairs, drives);
  return std::move(drives.front());
}
DriveRecording swapped(bool torques) {
  const Vehicle vehicle = preset_vehicle("lrv");
  return swapped(torques, sides_across(&vehicle));
}

std::size_t swaps_told(const DriveDiagnosis& diagnosis) {
  std::size_t count = 0;
  for (const DriveFinding& finding : diagnosis.findings) count += finding.id == "swapped_sides";
  return count;
}

TEST(ColumnsOfWheels, SwappedWheelSpeedsAreMendedAndNothingElseIsClaimed) {
  const DriveDiagnosis found = diagnosed(swapped(false));
  EXPECT_EQ(swaps_told(found), 1);
  EXPECT_TRUE(found.claims.empty());
}

TEST(ColumnsOfWheels, TorquesThatWereSwappedWithTheSpeedsAreMendedToo) {
  const DriveDiagnosis found = diagnosed(swapped(true));
  EXPECT_EQ(swaps_told(found), 2);
  EXPECT_TRUE(found.claims.empty());
}

/// One axle's columns had come out as zones of other soil, without a word of the columns.
TEST(ColumnsOfWheels, SwappedWheelSpeedsOfOneAxleAreMendedAndTorquesWithThem) {
  for (const WheelPair& axle : wheels_across(preset_vehicle("lrv"))) {
    for (const bool torques : {false, true}) {
      const DriveDiagnosis found = diagnosed(swapped(torques, {axle}));
      EXPECT_EQ(swaps_told(found), torques ? 2 : 1) << axle.first;
      EXPECT_TRUE(found.claims.empty()) << axle.first;
    }
  }
}

TEST(ColumnsOfWheels, SidesExchangedTwiceAreAsBefore) {
  const Vehicle vehicle = preset_vehicle("lrv");
  const DriveRecording before = sound_drive();
  std::vector<DriveRecording> drives{before};
  exchange("wheel_speed", sides_across(&vehicle), drives);
  EXPECT_EQ(drives[0].channel("wheel_speed_front_left_rad_s")->values,
            before.channel("wheel_speed_front_right_rad_s")->values);
  exchange("wheel_speed", sides_across(&vehicle), drives);
  for (std::size_t i = 0; i < before.channels.size(); ++i) {
    EXPECT_EQ(drives[0].channels[i].name, before.channels[i].name);
  }
}

}  // namespace
}  // namespace regoplan
