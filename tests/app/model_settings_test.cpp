#include "app/model_settings.h"

#include <gtest/gtest.h>

#include "tests/app/error_text.h"
#include "tests/app/simulant_model.h"

namespace regoplan {
namespace {

ModelSettings model(const std::string& yaml) {
  return read_model(parse_settings(yaml, "m.yaml"));
}

std::string error_of(const std::string& from, const std::string& to) {
  return error_text([&] { model(replaced(kSimulantModel, from, to)); });
}

TEST(ModelSettings, AMeanAndItsSpreadCountByTheMeanWhereOneNumberIsNeeded) {
  const ModelSettings plain = model(kSimulantModel);
  const ModelSettings spread =
      model(replaced(kSimulantModel, "cohesion_pa: 800", "cohesion_pa: {mean: 800, std: 90}"));
  EXPECT_EQ(spread.spec.soil.cohesion_pa, plain.spec.soil.cohesion_pa);
  EXPECT_EQ(spread.soil.standard_deviation.cohesion_pa, 90);
  EXPECT_EQ(plain.soil_name, "simulant");
  EXPECT_EQ(plain.spec.variant, WheelVariant::kIshigami2007);
}

TEST(ModelSettings, WhatCannotBeAModelIsAnErrorWithItsLine) {
  EXPECT_EQ(error_of("radius_m: 0.09", "radius_m: 0"),
            "m.yaml:2: wheel.radius_m: 0 is not valid (allowed: above 0)");
  EXPECT_EQ(error_of("gravity_mps2: 9.80665", "gravity_mps2: .inf"),
            "m.yaml:3: gravity_mps2: .inf is not valid (allowed: a number, above 0)");
  EXPECT_EQ(error_of("ishigami2007", "bekker1956"),
            "m.yaml:1: model: bekker1956 is not valid (allowed: ishigami2007 | yoshida2004)");
  EXPECT_EQ(error_of("ishigami2007", "yoshida2004"), "m.yaml:5: soil: c0_m is missing");
  EXPECT_TRUE(error_of("mechanisms: []", "mechanisms: [{id: stickiness}]")
                  .starts_with("m.yaml:19: mechanisms[0]"));
  EXPECT_TRUE(error_of("mechanisms: []",
                       "mechanisms: [{id: slip_sinkage, form: exponent, parameters: {n9: 1}}]")
                  .starts_with("m.yaml:19: mechanisms[0]"));
}

TEST(ModelSettings, MechanismsActOnTheForcesOfTheModel) {
  const ModelSettings base = model(kSimulantModel);
  const ModelSettings digging =
      model(replaced(kSimulantModel, "mechanisms: []",
                     "mechanisms: [{id: slip_sinkage, form: exponent, parameters: {n1: 0.3}}]"));
  ASSERT_EQ(digging.spec.mechanisms.size(), 1u);
  EXPECT_EQ(digging.spec.mechanisms[0].parameters.at("n1"), 0.3);
  const WheelMotion slipping = motion_at(0.5, 0);
  EXPECT_GT(WheelModel(digging.spec).forces(60, slipping).sinkage_m,
            1.1 * WheelModel(base.spec).forces(60, slipping).sinkage_m);
}

}  // namespace
}  // namespace regoplan
