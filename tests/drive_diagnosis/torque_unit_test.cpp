#include "drive_diagnosis/torque_unit.h"

#include <gtest/gtest.h>

#include "tests/drive_diagnosis/simulated_drive.h"

namespace regoplan {
namespace {

/// What is found of a drive whose torques are multiplied by so much.
std::optional<DriveFinding> found_in_torques(double times) {
  DriveRecording drive = record({}, rolling_map());
  for (DriveChannel& channel : drive.channels) {
    if (!channel.name.starts_with("torque_")) continue;
    for (float& value : channel.values) value *= static_cast<float>(times);
  }
  const std::vector<DriveWindow> windows = drive_windows(drive, 0, 5, 0);
  return doubtful_torque_unit({drive}, windows, preset_vehicle("lrv"), 1.62);
}

TEST(TorqueUnit, IsDoubtedWhereNoSoilTakesSuchTorques) {
  EXPECT_FALSE(found_in_torques(1));
  EXPECT_FALSE(found_in_torques(0.3));  // a motor constant far off
  EXPECT_FALSE(found_in_torques(3));
  const auto kilonewtons = found_in_torques(1e-3), millimetres = found_in_torques(1e3);
  ASSERT_TRUE(kilonewtons && millimetres);
  EXPECT_EQ(kilonewtons->id, "unit");
  EXPECT_NE(kilonewtons->text.find("kN m"), std::string::npos) << kilonewtons->text;
  EXPECT_NE(millimetres->text.find("N mm"), std::string::npos) << millimetres->text;
}

TEST(TorqueUnit, TorquesThatAreLeftOutAreGoneAndNothingElse) {
  std::vector<DriveRecording> drives{record({}, rolling_map())};
  const std::size_t before = drives[0].channels.size();
  leave_torques_out(drives);
  EXPECT_EQ(drives[0].channels.size(), before - 4);
  EXPECT_EQ(drives[0].channel("torque_front_left_nm"), nullptr);
  EXPECT_NE(drives[0].channel("wheel_speed_front_left_rad_s"), nullptr);
  EXPECT_FALSE(
      doubtful_torque_unit(drives, drive_windows(drives[0], 0, 5, 0), preset_vehicle("lrv"), 1.62));
}

}  // namespace
}  // namespace regoplan
