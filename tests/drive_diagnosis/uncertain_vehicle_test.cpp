#include <gtest/gtest.h>

#include "drive_diagnosis/vehicle_effects.h"
#include "tests/drive_diagnosis/simulated_drive.h"

namespace regoplan {
namespace {

DriveRecording with(std::vector<DriveChannel> channels) {
  DriveRecording drive;
  drive.channels = std::move(channels);
  return drive;
}

TEST(TellTorques, ACurrentOfAWheelIsATorqueWhereNoneIsRecorded) {
  DriveRecording drive =
      with({{"current_front_left_a", {2, 4}}, {"current_left_a", {1, 1}}, {"speed_mps", {1, 1}}});
  tell_torques(1.5, drive);
  ASSERT_NE(drive.channel("torque_front_left_nm"), nullptr);
  EXPECT_EQ(drive.channel("torque_front_left_nm")->values, (std::vector<float>{3, 6}));
  EXPECT_EQ(drive.channel("current_front_left_a")->values, (std::vector<float>{2, 4}));
  EXPECT_EQ(drive.channel("torque_left_nm"), nullptr);  // of a side: no wheel's
}

TEST(TellTorques, RecordedTorquesAreMultipliedAndNoCurrentTakesTheirPlace) {
  DriveRecording drive = with({{"torque_front_left_nm", {2}}, {"current_front_left_a", {7}}});
  tell_torques(0.5, drive);
  EXPECT_EQ(drive.channels.size(), 2U);
  EXPECT_EQ(drive.channel("torque_front_left_nm")->values, (std::vector<float>{1}));
}

/// A drive whose torques are told 10 % too large.
VehicleEffects told_too_large(const UncertainVehicle& uncertain) {
  const TerrainMap map = rolling_map();
  SimulatedDrive drive{.seed = 3};
  drive.deviation.motor_share.fill(0.1);
  const std::vector<DriveRecording> drives{record(drive, map)};
  const std::vector<DriveWindow> windows = drive_windows(drives[0], 0, 5, 0.3);
  return *find_vehicle_effects(drives, windows, map, preset_vehicle("lrv"), 1.62,
                               {.uncertain = uncertain, .seed = 7})
              .effects;
}

TEST(UncertainVehicle, ANumberThatNobodyKnowsIsEstimatedAndNotClaimed) {
  const VehicleEffects known = told_too_large({});
  ASSERT_FALSE(known.found.empty());
  EXPECT_EQ(known.found[0].id, "motor_constant");
  EXPECT_FALSE(known.vehicle.motor_constant);

  const VehicleEffects unknown = told_too_large({.motor_constant = DriveEstimate{1, 0.2}});
  EXPECT_TRUE(unknown.found.empty());
  ASSERT_TRUE(unknown.vehicle.motor_constant);
  const DriveEstimate& told = *unknown.vehicle.motor_constant;
  EXPECT_NEAR(told.value, 1 / 1.1, 3 * told.std);
  EXPECT_LT(told.std, 0.1);  // of .2 before
  EXPECT_FALSE(unknown.vehicle.mass_kg);
}

}  // namespace
}  // namespace regoplan
