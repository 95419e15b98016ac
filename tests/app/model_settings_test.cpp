#include "app/settings/model_settings.h"

#include <gtest/gtest.h>

#include "tests/app/simulant_model.h"
#include "tests/error_text.h"

namespace regoplan {
namespace {

ModelSettings model(const std::string& yaml) {
  return read_model(parse_settings(yaml, "m.yaml"));
}

std::string model_error(const std::string& from, const std::string& to) {
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
  EXPECT_EQ(model_error("radius_m: 0.09", "radius_m: 0"),
            "m.yaml:2: wheel.radius_m: 0 is not valid (allowed: above 0)");
  EXPECT_EQ(model_error("gravity_mps2: 9.80665", "gravity_mps2: .inf"),
            "m.yaml:3: gravity_mps2: .inf is not valid (allowed: a number, above 0 to 100)");
  EXPECT_EQ(model_error("gravity_mps2: 9.80665", "gravity_mps2: 980.665"),
            "m.yaml:3: gravity_mps2: 980.665 is not valid (allowed: above 0 to 100)");
  EXPECT_EQ(model_error("ishigami2007", "bekker1956"),
            "m.yaml:1: model: bekker1956 is not valid (allowed: ishigami2007 | yoshida2004)");
  EXPECT_EQ(model_error("kc: 1.37e3", "kc: -1e9"),
            "m.yaml:8: soil.kc: -1000000000 is not valid (allowed: kc/width_m + kphi above 0, with "
            "kphi 814000 and wheels of 0.1 m)");
  EXPECT_EQ(model_error("ishigami2007", "yoshida2004"), "m.yaml:5: soil: c0_m is missing");
  EXPECT_TRUE(model_error("mechanisms: []", "mechanisms: [{id: stickiness}]")
                  .starts_with("m.yaml:19: mechanisms[0]"));
  EXPECT_TRUE(model_error("mechanisms: []",
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

/// As the simulant's model file, with two mechanisms and a correction of the unnamed rest.
const std::string kCorrectedModel = replaced(kSimulantModel, "mechanisms: []", R"(mechanisms:
  - id: slip_sinkage
    form: exponent
    parameters: {n1: 0.31}
  - {id: grousers}
  - id: generic
    form: gaussian_bumps
    parameters:
      slip_scale: 0.2
      slip_angle_scale_deg: 11.3
      log_load_scale: 0.5
      region: {slip_ratio: [-0.5, 0.8], slip_angle_deg: [0, 16], load_n: [50, 75]}
      fade_share: 0.05
      nodes:
        - {slip_ratio: 0.1, slip_angle_deg: 0, load_n: 64.7, fx_n: 1.25}
        - {slip_ratio: 0.4, slip_angle_deg: 15.3, load_n: 64.7, fx_n: -3, fy_n: 2, torque_nm: .1, sinkage_m: 1e-3})");

TEST(ModelSettings, AGenericCorrectionActsInItsRegion) {
  const ModelSettings read = model(kCorrectedModel);
  ASSERT_TRUE(read.spec.generic);
  EXPECT_EQ(read.spec.mechanisms.size(), 2u);
  EXPECT_EQ(read.spec.generic->nodes.size(), 2u);
  EXPECT_EQ(read.spec.generic->nodes[0].fy_n, 0);
  EXPECT_EQ(WheelModel(read.spec).forces(60, motion_at(0.3, 0.1)).status, WheelStatus::kOk);
  EXPECT_EQ(WheelModel(read.spec).forces(60, motion_at(0.9, 0.1)).status,
            WheelStatus::kOutsideCorrection);
}

TEST(ModelSettings, ReadBackBitForBitAsTheyWereWritten) {
  for (const std::string& yaml :
       {std::string(kSimulantModel), kCorrectedModel,
        replaced(kCorrectedModel, "friction_angle_deg: 37.2",
                 "friction_angle_deg: {mean: 36.7123456789, std: 1.3}")}) {
    const ModelSettings once = model(yaml);
    const std::string text = model_text(once);
    const ModelSettings again = model(text);
    EXPECT_EQ(model_text(again), text);
    EXPECT_EQ(again.soil_name, once.soil_name);
    for (const SoilParameter& parameter : soil_parameters()) {
      EXPECT_EQ(again.soil.mean.*parameter.member, once.soil.mean.*parameter.member);
      EXPECT_EQ(again.soil.standard_deviation.*parameter.member,
                once.soil.standard_deviation.*parameter.member);
    }
    const WheelModel one(once.spec), other(again.spec);
    for (const double slip : {-0.3, 0.2, 0.9}) {
      const WheelForces a = one.forces(61, motion_at(slip, 0.2));
      const WheelForces b = other.forces(61, motion_at(slip, 0.2));
      EXPECT_EQ(a.fx_n, b.fx_n);
      EXPECT_EQ(a.fy_n, b.fy_n);
      EXPECT_EQ(a.torque_nm, b.torque_nm);
      EXPECT_EQ(a.sinkage_m, b.sinkage_m);
      EXPECT_EQ(a.status, b.status);
    }
  }
}

TEST(ModelSettings, WhatCannotBeAGenericCorrectionIsAnErrorWithItsLine) {
  const auto error = [](const std::string& from, const std::string& to) {
    return error_text([&] { model(replaced(kCorrectedModel, from, to)); });
  };
  EXPECT_EQ(error("form: gaussian_bumps", "form: splines"),
            "m.yaml:25: mechanisms[2].form: splines is not valid (allowed: gaussian_bumps)");
  EXPECT_EQ(error("slip_scale: 0.2", "slip_scale: 0"),
            "m.yaml:27: mechanisms[2].parameters.slip_scale: 0 is not valid (allowed: above 0)");
  EXPECT_EQ(error("[-0.5, 0.8]", "[0.8, -0.5]"),
            "m.yaml:30: mechanisms[2].parameters.region.slip_ratio: -0.5 is not valid (allowed: "
            "above its other end)");
  EXPECT_EQ(error("[-0.5, 0.8]", "[0.8]"),
            "m.yaml:30: mechanisms[2].parameters.region.slip_ratio: 1 numbers (allowed: [from, "
            "to])");
  EXPECT_EQ(error("torque_nm: .1", "torque_nm: .nan"),
            "m.yaml:34: mechanisms[2].parameters.nodes[1].torque_nm: .nan is not valid (allowed: "
            "any finite number)");
  EXPECT_NE(error("fx_n: 1.25", "fz_n: 1.25").find("m.yaml:33: "), std::string::npos);
  EXPECT_EQ(error("fade_share: 0.05", "fade_share: 0.7"),
            "m.yaml:31: mechanisms[2].parameters.fade_share: 0.7 is not valid (allowed: 0 to 0.5)");
  EXPECT_NE(error("{id: grousers}",
                  "{id: generic, parameters: {slip_scale: 1, slip_angle_scale_deg: 1, "
                  "log_load_scale: 1, region: {slip_ratio: [0, 1], slip_angle_deg: [0, 1], load_n: "
                  "[1, 2]}, nodes: []}}")
                .find("generic stands twice"),
            std::string::npos);
}

}  // namespace
}  // namespace regoplan
