#include "app/diagnose/diagnosis_setup.h"

#include <gtest/gtest.h>

#include "tests/app/simulant_model.h"
#include "tests/error_text.h"

namespace regoplan {
namespace {

SetupSettings setup(const std::string& yaml) {
  return read_setup(parse_settings(yaml, "s.yaml"));
}

std::string setup_error(const std::string& from, const std::string& to) {
  return error_text([&] { setup(replaced(kSimulantModel, from, to)); });
}

TEST(DiagnosisSetup, AModelFileWillDo) {
  const SetupSettings read =
      setup(replaced(kSimulantModel, "cohesion_pa: 800", "cohesion_pa: {mean: 800, std: 90}"));
  EXPECT_EQ(read.setup.wheel.radius_m, 0.09);
  EXPECT_EQ(read.setup.soil.mean.cohesion_pa, 800);
  EXPECT_EQ(read.setup.soil.standard_deviation.cohesion_pa, 90);
  EXPECT_EQ(read.soil_name, "simulant");
  EXPECT_TRUE(read.setup.noise_standard_deviation.empty());
  EXPECT_TRUE(read.warnings.empty());
}

TEST(DiagnosisSetup, NoiseIsOfAChannelAndAbove0) {
  const SetupSettings read =
      setup(std::string(kSimulantModel) + "noise: {fx_n: 0.8, sinkage_m: 6.5e-4}\n");
  EXPECT_EQ(read.setup.noise_standard_deviation.at(Channel::kFx), 0.8);
  EXPECT_EQ(read.setup.noise_standard_deviation.at(Channel::kSinkage), 6.5e-4);
  EXPECT_EQ(error_text([] { setup(std::string(kSimulantModel) + "noise: {fx_n: 0}\n"); }),
            "s.yaml:20: noise.fx_n: 0 is not valid (allowed: above 0)");
  EXPECT_NE(error_text([] {
              setup(std::string(kSimulantModel) + "noise: {fz_n: 1}\n");
            }).find("s.yaml:20: noise.fz_n: unknown key"),
            std::string::npos);
}

TEST(DiagnosisSetup, AWheelMayHaveLugs) {
  const std::string with = "radius_m: 0.09, lug_height_m: 0.01, lug_count: 18";
  const SetupSettings read = setup(replaced(kSimulantModel, "radius_m: 0.09", with));
  EXPECT_EQ(read.setup.lug_height_m, 0.01);
  EXPECT_EQ(read.setup.lug_count, 18);
  EXPECT_FALSE(setup(std::string(kSimulantModel)).setup.lug_height_m);
  EXPECT_EQ(setup_error("radius_m: 0.09", "radius_m: 0.09, lug_height_m: 10"),
            "s.yaml:2: wheel.lug_height_m: 10 is not valid (allowed: 0 to 0.2)");
}

TEST(DiagnosisSetup, WhatCannotBeIsAnErrorWithItsLine) {
  EXPECT_EQ(setup_error("radius_m: 0.09", "radius_m: 90"),
            "s.yaml:2: wheel.radius_m: 90 is not valid (allowed: above 0 to 5); suspected: mm");
  EXPECT_EQ(setup_error("ishigami2007", "bekker1956"),
            "s.yaml:1: model: bekker1956 is not valid (allowed: ishigami2007 | yoshida2004)");
  EXPECT_NE(setup_error("gravity_mps2", "gravity").find("s.yaml:1: gravity_mps2 is missing"),
            std::string::npos);
  EXPECT_EQ(setup_error("mechanisms: []", "mechanisms: [{id: grousers}]"),
            "s.yaml:19: mechanisms: a diagnosis starts from the base model (allowed: none)");
  EXPECT_NE(setup_error("lambda", "lamda").find("lambda is missing"), std::string::npos);
}

TEST(DiagnosisSetup, NumbersThatLookLikeAnotherUnitAreReported) {
  const SetupSettings read =
      setup(replaced(kSimulantModel, "friction_angle_deg: 37.2", "friction_angle_deg: 0.65"));
  ASSERT_EQ(read.warnings.size(), 1u);
  EXPECT_EQ(
      read.warnings[0],
      "s.yaml:7: soil.friction_angle_deg: 0.65 is small for a soil (usual: from 2 on); suspected: "
      "radians");
}

}  // namespace
}  // namespace regoplan
