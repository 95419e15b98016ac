#include "app/diagnose_drive/drive_setup.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/error_text.h"
#include "tests/scratch_folder.h"

namespace regoplan {
namespace {

const std::string kScenario =
    "map: {soils: " + std::filesystem::absolute("scenarios/demo/soils.yaml").string() +
    ", terrain: {width_m: 40, height_m: 20, roughness_m: 0}}\n"
    "gravity_mps2: 1.62\n";

class DriveSetupFileTest : public testing::Test {
 protected:
  DriveSetupFile read(const std::string& scenario, const std::string& setup) const {
    return read_drive_setup(folder_.write("scenario.yaml", scenario),
                            folder_.write("setup.yaml", setup));
  }
  std::string error(const std::string& setup, const std::string& vehicle = "vehicle: lrv\n") const {
    return error_text([&] { read(kScenario + vehicle, setup); });
  }
  ScratchFolder folder_;
};

TEST_F(DriveSetupFileTest, MeansOfNumbersThatNobodyKnowsTakeThePlaceOfTheVehicles) {
  const DriveSetup setup = read(kScenario + "vehicle: lrv\n",
                                "vehicle:\n"
                                "  mass_kg: {mean: 640, std: 60}\n"
                                "  wheel_radius_m: {mean: 0.4, std: 0.01}\n"
                                "  motor_constant: {mean: 1.8, std: 0.3}\n")
                               .setup;
  EXPECT_EQ(setup.vehicle->mass_kg, 640);
  EXPECT_EQ(setup.vehicle->wheel.radius_m, 0.4);
  EXPECT_EQ(setup.uncertain.mass_kg->std, 60);
  EXPECT_EQ(setup.uncertain.wheel_radius_m->std, 0.01);
  EXPECT_EQ(setup.uncertain.motor_constant->value, 1.8);
}

TEST_F(DriveSetupFileTest, WithoutThemTheVehicleIsAsTheScenarioSays) {
  const DriveSetup setup = read(kScenario + "vehicle: lrv\n", "window_s: 4\n").setup;
  EXPECT_EQ(setup.vehicle->mass_kg, preset_vehicle("lrv").mass_kg);
  EXPECT_EQ(setup.window_s, 4);
  EXPECT_FALSE(setup.uncertain.mass_kg || setup.uncertain.motor_constant);
}

TEST_F(DriveSetupFileTest, WhatCannotBeIsAnErrorWithItsLine) {
  const auto says = [&](const std::string& setup, const std::string& what) {
    EXPECT_NE(error(setup).find(what), std::string::npos) << error(setup);
  };
  says("vehicle: {mass_kg: 640}\n", "setup.yaml:1: vehicle.mass_kg: {mean, std} is expected");
  says("vehicle:\n  mass_kg: {mean: -1, std: 60}\n", "setup.yaml:2: vehicle.mass_kg.mean: -1");
  says("vehicle: {mass_kg: {mean: 640}}\n", "std is missing");
  says("vehicle: {tyre_m: {mean: 1, std: 1}}\n", "vehicle.tyre_m: unknown key");
  EXPECT_NE(error("vehicle: {mass_kg: {mean: 640, std: 60}}\n", "").find("has no vehicle"),
            std::string::npos);
}

}  // namespace
}  // namespace regoplan
