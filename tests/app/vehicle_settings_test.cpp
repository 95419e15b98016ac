#include "app/settings/vehicle_settings.h"

#include <gtest/gtest.h>

#include "tests/error_text.h"
#include "tests/scratch_folder.h"

namespace regoplan {
namespace {

Vehicle vehicle(const std::string& yaml) {
  return read_vehicle(parse_settings(yaml, "v.yaml"));
}

TEST(VehicleSettings, WrittenVehiclesReadBackBitForBit) {
  for (const std::string& name : preset_vehicle_names()) {
    SCOPED_TRACE(name);
    const Vehicle preset = preset_vehicle(name);
    const Vehicle again = vehicle(vehicle_text(preset));
    EXPECT_EQ(vehicle_text(again), vehicle_text(preset));
    EXPECT_EQ(again.mass_kg, preset.mass_kg);
    EXPECT_EQ(again.steer_angle_max_rad, preset.steer_angle_max_rad);
    EXPECT_EQ(again.slope_max_rad, preset.slope_max_rad);
    EXPECT_EQ(again.wheels.size(), preset.wheels.size());
    EXPECT_EQ(again.wheels.back().x_m, preset.wheels.back().x_m);
    EXPECT_EQ(again.wheels.back().steered, preset.wheels.back().steered);
    EXPECT_EQ(again.suspension, preset.suspension);
    EXPECT_EQ(again.rocker_bogie.has_value(), preset.rocker_bogie.has_value());
    EXPECT_EQ(again.drive_law, preset.drive_law);
    EXPECT_EQ(again.body.x_min_m, preset.body.x_min_m);
  }
}

TEST(VehicleSettings, SteeringAndTorqueLimitReadBack) {
  Vehicle crabbing = preset_vehicle("tohoku");
  crabbing.steering = Steering::kCrab;
  crabbing.torque_max_nm = 12.5;
  const Vehicle again = vehicle(vehicle_text(crabbing));
  EXPECT_EQ(again.steering, Steering::kCrab);
  EXPECT_EQ(again.torque_max_nm, 12.5);
}

TEST(VehicleSettings, WhatCannotBeAVehicleIsAnErrorWithItsLine) {
  const std::string lrv = vehicle_text(preset_vehicle("lrv"));
  const auto first_line = [&lrv](const std::string& key, const std::string& value) {
    std::string yaml = lrv;
    const std::size_t at = yaml.find(key + ": ");
    yaml.replace(at, yaml.find('\n', at) - at, key + ": " + value);
    return error_text([&] { vehicle(yaml); });
  };
  // Too small or too large, the same is said to be allowed.
  for (const std::string beyond : {"-5", "1e-09", "8.99e+09"}) {
    EXPECT_EQ(first_line("mass_kg", beyond),
              "v.yaml:3: mass_kg: " + beyond + " is not valid (allowed: 0.1 to 1000000)");
  }
  EXPECT_EQ(first_line("mass_kg", ".nan"),
            "v.yaml:3: mass_kg: .nan is not valid (allowed: a number, 0.1 to 1000000)");
  EXPECT_EQ(first_line("drive_law", "magic"),
            "v.yaml:" +
                std::to_string(
                    1 + std::count(lrv.begin(),
                                   lrv.begin() + static_cast<long>(lrv.find("drive_law")), '\n')) +
                ": drive_law: magic is not valid (allowed: kinematic | equal_torque | "
                "equal_speed)");
  // What only the vehicle itself can judge comes back to the line as well.
  EXPECT_TRUE(first_line("slip_max", "0.99").starts_with("v.yaml:13: slip_max: 0.99 is not valid"))
      << first_line("slip_max", "0.99");
  EXPECT_NE(error_text([&] { vehicle(lrv + "wings: 2\n"); }).find("wings: unknown key"),
            std::string::npos);
}

TEST(VehicleSettings, AScenarioNamesAPresetOrAFileBesideIt) {
  const ScratchFolder folder;
  folder.write("mine.yaml", replaced(vehicle_text(preset_vehicle("lrv")), "'lrv'", "'mine'"));
  const auto named = [&folder](const std::string& name) {
    const SettingsNode root = parse_settings("vehicle: " + name, folder.path("s.yaml"));
    return named_vehicle(*root.find("vehicle"), folder.path(""));
  };
  EXPECT_EQ(named("curiosity").name, "curiosity");
  EXPECT_EQ(named("mine.yaml").name, "mine");
  EXPECT_NE(error_text([&] { named("lvr"); }).find("s.yaml:1: vehicle: lvr is not valid"),
            std::string::npos);
}

}  // namespace
}  // namespace regoplan
