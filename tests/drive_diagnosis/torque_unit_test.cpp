#include "drive_diagnosis/instruments/torque_unit.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "drive_diagnosis/drive_diagnosis.h"
#include "tests/drive_diagnosis/simulated_drive.h"

namespace regoplan {
namespace {

/// What is found of a drive whose torques are multiplied by so much.
std::vector<DriveFinding> found_in_torques(double times) {
  DriveRecording drive = record({}, rolling_map());
  for (DriveChannel& channel : drive.channels) {
    if (!channel.name.starts_with("torque_")) continue;
    for (float& value : channel.values) value *= static_cast<float>(times);
  }
  const std::vector<DriveWindow> windows = drive_windows(drive, 0, 5, 0);
  return doubtful_torque_units({drive}, windows, preset_vehicle("lrv"), 1.62);
}

TEST(TorqueUnit, IsDoubtedWhereNoSoilTakesSuchTorques) {
  EXPECT_TRUE(found_in_torques(1).empty());
  EXPECT_TRUE(found_in_torques(0.3).empty());  // a motor constant far off
  EXPECT_TRUE(found_in_torques(3).empty());
  EXPECT_TRUE(found_in_torques(0).empty());  // a dead sensor has no unit
  const auto kilonewtons = found_in_torques(1e-3), millimetres = found_in_torques(1e3);
  ASSERT_TRUE(kilonewtons.size() == 1 && millimetres.size() == 1);
  EXPECT_EQ(kilonewtons[0].id, "unit");
  EXPECT_NE(kilonewtons[0].text.find("kN m"), std::string::npos) << kilonewtons[0].text;
  EXPECT_NE(millimetres[0].text.find("N mm"), std::string::npos) << millimetres[0].text;
}

TEST(TorqueUnit, OfOneDriveIsToldOfThatOne) {
  std::vector<DriveRecording> drives{record({.seed = 1}, rolling_map()),
                                     record({.seed = 2}, rolling_map())};
  drives[1].drive_id = "second";
  for (DriveChannel& channel : drives[1].channels) {
    if (!channel.name.starts_with("torque_")) continue;
    for (float& value : channel.values) value *= 1e-3F;
  }
  std::vector<DriveWindow> windows = drive_windows(drives[0], 0, 5, 0);
  for (const DriveWindow& window : drive_windows(drives[1], 1, 5, 0)) windows.push_back(window);
  const auto found = doubtful_torque_units(drives, windows, preset_vehicle("lrv"), 1.62);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].drive, "second");
}

/// What a diagnosis says of a drive whose torques, which come before all other channels, are told
/// in so many times N m.
DriveDiagnosis diagnosed_in(double times) {
  DriveRecording drive = record({}, rolling_map());
  std::stable_partition(
      drive.channels.begin(), drive.channels.end(),
      [](const DriveChannel& channel) { return channel.name.starts_with("torque_"); });
  for (DriveChannel& channel : drive.channels) {
    if (!channel.name.starts_with("torque_")) continue;
    for (float& value : channel.values) value *= static_cast<float>(times);
  }
  return diagnose_drives(
      {drive},
      {.map = rolling_map(), .vehicle = preset_vehicle("lrv"), .gravity_mps2 = 1.62, .window_s = 5},
      {});
}

TEST(TorqueUnit, WhatIsLeftOutLeavesAllElseInItsPlace) {
  const DriveDiagnosis diagnosis = diagnosed_in(1e-3);
  EXPECT_EQ(diagnosis.verdict, DriveVerdict::kConsistent);
  ASSERT_EQ(diagnosis.findings.size(), 1u);
  EXPECT_EQ(diagnosis.findings[0].id, "unit");
  ASSERT_TRUE(diagnosis.effects);
  EXPECT_FALSE(diagnosis.effects->has_torque);
  EXPECT_GT(diagnosis.effects->windows, 20);
}

}  // namespace
}  // namespace regoplan
