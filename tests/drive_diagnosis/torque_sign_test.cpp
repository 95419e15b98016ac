#include "drive_diagnosis/comparison/torque_sign.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>

#include "drive_diagnosis/drive_diagnosis.h"
#include "tests/drive_diagnosis/simulated_drive.h"

namespace regoplan {
namespace {

/// What is said of a drive with the torques of some wheels turned round.
DriveDiagnosis diagnosed_reversed(const std::vector<std::string>& wheels, SimulatedDrive how = {}) {
  std::vector<DriveRecording> drives{record(how, rolling_map())};
  std::vector<DriveWindow> none;
  for (const std::string& wheel : wheels)
    reverse_torque({.wheel = wheel, .drives = {0}}, drives, none);
  return diagnose_drives(
      std::move(drives),
      {.map = rolling_map(), .vehicle = preset_vehicle("lrv"), .gravity_mps2 = 1.62, .window_s = 5},
      {});
}

TEST(TorqueSign, OfOneWheelIsAFindingAndNoPayload) {
  const DriveDiagnosis diagnosis = diagnosed_reversed({"rear_left"});
  EXPECT_EQ(diagnosis.verdict, DriveVerdict::kConsistent);
  ASSERT_EQ(diagnosis.findings.size(), 1u);
  EXPECT_EQ(diagnosis.findings[0].id, "sign");
  EXPECT_TRUE(diagnosis.findings[0].mended);
  EXPECT_NE(diagnosis.findings[0].text.find("torque_rear_left_nm"), std::string::npos);
  ASSERT_TRUE(diagnosis.effects);
  EXPECT_TRUE(diagnosis.effects->has_torque);
}

TEST(TorqueSign, OfEveryWheelIsToldOfEach) {
  const DriveDiagnosis diagnosis =
      diagnosed_reversed({"front_left", "front_right", "rear_left", "rear_right"});
  EXPECT_EQ(diagnosis.findings.size(), 4u);
  EXPECT_EQ(diagnosis.verdict, DriveVerdict::kConsistent);
}

TEST(TorqueSign, IsJudgedDriveByDriveAsALoggerMayBeMountedAnewBetweenTwo) {
  const TerrainMap map = rolling_map();
  std::vector<DriveRecording> drives{record({.seed = 1}, map), record({.seed = 2}, map)};
  std::vector<DriveWindow> windows = drive_windows(drives[0], 0, 5, 0.3);
  std::ranges::copy(drive_windows(drives[1], 1, 5, 0.3), std::back_inserter(windows));
  const ReversedTorque second{.wheel = "rear_left", .drives = {1}};
  reverse_torque(second, drives, windows);
  const auto reversed = [&] {
    return wheels_with_torque_reversed(drives, windows, map, preset_vehicle("lrv"), 1.62, 2, {});
  };
  const std::vector<ReversedTorque> found = reversed();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].wheel, second.wheel);
  EXPECT_EQ(found[0].drives, second.drives);
  reverse_torque(found[0], drives, windows);
  EXPECT_TRUE(reversed().empty());
}

TEST(TorqueSign, OfADriveTooShortToSayIsThatOfTheOthers) {
  const TerrainMap map = rolling_map();
  std::vector<DriveRecording> drives{record({.seed = 1}, map), record({.seed = 2}, map)};
  std::vector<DriveWindow> windows = drive_windows(drives[0], 0, 5, 0.3);
  const auto second = drive_windows(drives[1], 1, 5, 0.3);
  std::ranges::copy(second.begin() + 8, second.begin() + 13, std::back_inserter(windows));
  reverse_torque({.wheel = "rear_left", .drives = {0, 1}}, drives, windows);
  const auto found =
      wheels_with_torque_reversed(drives, windows, map, preset_vehicle("lrv"), 1.62, 2, {});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].drives, (std::vector<std::size_t>{0, 1}));
}

TEST(TorqueSign, OfWheelsThatDragDownADescentIsNotReversed) {
  constexpr double kFall = 0.084;  // 4.8 deg
  const TerrainMap map = map_of_heights([](int column, int) { return -kFall * column; });
  SimulatedDrive dragging{.seed = 3};
  dragging.deviation.wheel_drag_nm.fill(5);
  const std::vector<DriveRecording> drives{record(dragging, map)};
  const std::vector<DriveWindow> windows = drive_windows(drives[0], 0, 5, 0.3);
  EXPECT_TRUE(wheels_with_torque_reversed(drives, windows, map, preset_vehicle("lrv"), 1.62, 2, {})
                  .empty());
}

TEST(TorqueSign, IsLeftAsItIsWhereFaultsOfTheVehicleExplainTheTorques) {
  SimulatedDrive dragging{.seed = 21};
  dragging.deviation.wheel_drag_nm[1] = -8;  // pushed on
  dragging.deviation.motor_share.fill(-0.5);
  const DriveDiagnosis diagnosis = diagnosed_reversed({}, dragging);
  for (const DriveFinding& finding : diagnosis.findings) EXPECT_NE(finding.id, "sign");
}

}  // namespace
}  // namespace regoplan
