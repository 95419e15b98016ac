// What is otherwise in some drives only is no fault of all of them.
#include "drive_diagnosis/differing_drives.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "tests/drive_diagnosis/simulated_drive.h"

namespace regoplan {
namespace {

DriveRecording of_drive(const std::string& drive_id, std::uint64_t seed, double drag_nm) {
  SimulatedDrive drive{.seed = seed};
  drive.deviation.wheel_drag_nm[3] = drag_nm;
  DriveRecording recording = record(drive, rolling_map());
  recording.drive_id = drive_id;
  return recording;
}

DriveDiagnosis diagnosed_together(const std::vector<DriveRecording>& drives) {
  return diagnose_drives(
      drives,
      {.map = rolling_map(), .vehicle = preset_vehicle("lrv"), .gravity_mps2 = 1.62, .window_s = 5},
      {});
}

TEST(DifferingDrives, AWheelThatDragsInOneOfThemIsNoVerdictOnBoth) {
  const DriveDiagnosis diagnosis =
      diagnosed_together({of_drive("sound", 1, 0), of_drive("dragging", 2, 7)});
  EXPECT_EQ(diagnosis.verdict, DriveVerdict::kUndecided);
  EXPECT_TRUE(diagnosis.claims.empty());
  const auto differs = std::ranges::find(diagnosis.findings, "drives_differ", &DriveFinding::id);
  ASSERT_NE(differs, diagnosis.findings.end());
  EXPECT_NE(differs->text.find("torque_"), std::string::npos) << differs->text;
}

TEST(DifferingDrives, AWheelThatDragsInAllIsNamed) {
  const DriveDiagnosis diagnosis =
      diagnosed_together({of_drive("first", 1, 7), of_drive("second", 2, 7)});
  EXPECT_EQ(std::ranges::count(diagnosis.findings, "drives_differ", &DriveFinding::id), 0);
  ASSERT_FALSE(diagnosis.claims.empty());
  EXPECT_EQ(diagnosis.claims[0].id, "wheel_drag");
}

struct Windows {
  std::size_t first = 0, last = 0;
};

/// Two drives of twenty windows and one of none, and zones over some of the second's.
std::vector<DriveFinding> differing_by_zones(const std::vector<Windows>& zones) {
  const std::vector<DriveRecording> drives{{.drive_id = "a"}, {.drive_id = "b"}, {.drive_id = "c"}};
  std::vector<DriveWindow> windows(40);
  for (std::size_t i = 20; i < windows.size(); ++i) windows[i].drive = 1;
  VehicleEffects effects;
  for (const auto& [first, last] : zones) {
    effects.found.push_back(
        {.id = "soil_zone", .zone = SoilZoneFound{.drive = 1, .first = first, .last = last}});
  }
  return differing_drives(drives, windows, effects);
}

TEST(DifferingDrives, AZoneAlongNearlyAllOfOneOfThemMayBeItsVehicle) {
  EXPECT_EQ(differing_by_zones({{21, 39}}).size(), 1u);
  EXPECT_EQ(differing_by_zones({{21, 35}}).size(), 0u);
}

TEST(DifferingDrives, ZonesOnEachSoilAlongNearlyAllOfOneOfThemMayBeItsVehicle) {
  const auto differing = differing_by_zones({{20, 29}, {31, 39}});
  ASSERT_EQ(differing.size(), 1u);
  EXPECT_EQ(differing[0].drive, "b");
  EXPECT_EQ(differing_by_zones({{20, 24}, {35, 39}}).size(), 0u);
}

/// The recording without the channels whose names begin so.
DriveRecording without(DriveRecording recording, const std::vector<std::string>& beginnings) {
  std::erase_if(recording.channels, [&](const DriveChannel& channel) {
    return std::ranges::any_of(
        beginnings, [&](const std::string& name) { return channel.name.starts_with(name); });
  });
  return recording;
}

TEST(DifferingDrives, ADriveThatCannotBeComparedHidesNothingOfAnother) {
  const DriveDiagnosis diagnosis = diagnosed_together(
      {of_drive("dragging", 2, 7), without(of_drive("poses", 1, 0), {"wheel_speed", "torque"})});
  ASSERT_FALSE(diagnosis.claims.empty());
  EXPECT_EQ(diagnosis.claims[0].id, "wheel_drag");
  const auto told = std::ranges::find(diagnosis.findings, "not_compared", &DriveFinding::id);
  ASSERT_NE(told, diagnosis.findings.end());
  EXPECT_EQ(told->drive, "poses");
}

TEST(DifferingDrives, AChannelThatOneOfThemLacksIsToldToBeComparedOfNone) {
  const DriveDiagnosis diagnosis = diagnosed_together(
      {of_drive("dragging", 2, 7), without(of_drive("silent", 1, 0), {"torque"})});
  const auto told = std::ranges::find(diagnosis.findings, "channel_missing", &DriveFinding::id);
  ASSERT_NE(told, diagnosis.findings.end());
  EXPECT_EQ(told->drive, "silent");
  EXPECT_NE(told->text.find("torque_"), std::string::npos) << told->text;
}

/// Two drives of twenty windows whose residuals are told.
std::vector<DriveFinding> differing(const std::function<double(std::size_t)>& residual) {
  const std::vector<DriveRecording> drives{{.drive_id = "a"}, {.drive_id = "b"}};
  std::vector<DriveWindow> windows(40);
  ComparedChannel channel{.name = "torque_nm", .corrected = std::vector<double>(40, 0.0)};
  for (std::size_t i = 0; i < windows.size(); ++i) {
    windows[i].drive = i < 20 ? 0 : 1;
    channel.windows.push_back(i);
    channel.measured.push_back(residual(i));
  }
  VehicleEffects effects;
  effects.compared = {channel};
  return differing_drives(drives, windows, effects);
}

TEST(DifferingDrives, AreToldByTheMiddleOfWhatIsLeftAgainstTheScatterOfAWindow) {
  const auto scatter = [](std::size_t i) { return i % 2 == 0 ? 1.0 : -1.0; };
  EXPECT_TRUE(differing(scatter).empty());
  // A zone in a third of one drive does not move the middle of all its windows.
  EXPECT_TRUE(differing([&](std::size_t i) { return scatter(i) + (i < 7 ? 50 : 0); }).empty());
  const auto apart = differing([&](std::size_t i) { return scatter(i) + (i < 20 ? 12 : 0); });
  ASSERT_EQ(apart.size(), 1u);
  EXPECT_EQ(apart[0].drive, "a");
  EXPECT_NEAR(apart[0].value.value_or(0), 12, 1e-9);
}

}  // namespace
}  // namespace regoplan
