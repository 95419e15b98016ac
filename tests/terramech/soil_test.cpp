#include "terramech/parameters/soil.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "terramech/basics/input_error.h"
#include "tests/terramech/lunar_soil.h"

namespace regoplan {
namespace {

constexpr double kWidth_m = 0.23;

/// The field that `validate` complains of; empty where it is content.
std::string rejected_field(const Soil& soil) {
  try {
    validate(soil);
  } catch (const ValueError& error) {
    return error.field();
  }
  return "";
}

Soil firm_with(const SoilParameter& parameter, double file_value) {
  Soil soil = firm_regolith();
  soil.*parameter.member = file_value * parameter.file_unit;
  return soil;
}

/// a0 and a1 are valid only together.
bool stands_alone(const SoilParameter& parameter) {
  return parameter.name != "a0" && parameter.name != "a1";
}

TEST(Soil, TheEndsOfEveryRangeAreValidUnlessExcluded) {
  for (const SoilParameter& parameter : soil_parameters()) {
    if (!stands_alone(parameter)) continue;
    EXPECT_EQ(rejected_field(firm_with(parameter, parameter.max)), "") << parameter.name;
    EXPECT_EQ(rejected_field(firm_with(parameter, parameter.min)),
              parameter.min_excluded ? parameter.name : "")
        << parameter.name;
  }
}

TEST(Soil, WhatIsOutsideItsRangeIsNamed) {
  for (const SoilParameter& parameter : soil_parameters()) {
    const double beyond = 1e-3 * (parameter.max - parameter.min);
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double value :
         {parameter.min - beyond, parameter.max + beyond, std::nan(""), infinity, -infinity}) {
      EXPECT_EQ(rejected_field(firm_with(parameter, value)), parameter.name) << value;
    }
  }
}

TEST(Soil, TheStressPeaksWithinTheContactAtEverySlip) {
  Soil soil = firm_regolith();
  soil.a0 = 0.3;
  soil.a1 = 0.3;  // theta_m = theta_r at s = -1
  EXPECT_EQ(rejected_field(soil), "a1");
  soil.a1 = -0.3;
  EXPECT_EQ(rejected_field(soil), "a1");
  soil.a1 = 0.29;
  EXPECT_EQ(rejected_field(soil), "");
  soil.a0 = 0.8;
  EXPECT_EQ(rejected_field(soil), "a1");
}

TEST(SoilDraw, ANumberWithoutUncertaintyIsKnown) {
  UncertainSoil soil{.mean = firm_regolith()};
  std::mt19937_64 random(1);
  const Soil drawn = draw(soil, kWidth_m, random);
  for (const SoilParameter& parameter : soil_parameters()) {
    EXPECT_EQ(drawn.*parameter.member, soil.mean.*parameter.member) << parameter.name;
  }
}

TEST(SoilDraw, TheSameSeedDrawsTheSameSoil) {
  UncertainSoil soil{.mean = firm_regolith()};
  soil.standard_deviation.cohesion_pa = 50;
  soil.standard_deviation.kphi = 2e5;
  std::mt19937_64 one(7), other(7), third(8);
  const Soil drawn = draw(soil, kWidth_m, one), same = draw(soil, kWidth_m, other),
             different = draw(soil, kWidth_m, third);
  EXPECT_EQ(drawn.cohesion_pa, same.cohesion_pa);
  EXPECT_EQ(drawn.kphi, same.kphi);
  EXPECT_NE(drawn.cohesion_pa, different.cohesion_pa);
}

TEST(SoilDraw, MeanAndDeviationAreThoseOfTheTests) {
  UncertainSoil soil{.mean = firm_regolith()};
  soil.standard_deviation.friction_angle_rad = 2 * kDegree;
  std::mt19937_64 random(20040928);
  constexpr int kDraws = 10000;
  double sum = 0, squares = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double off =
        draw(soil, kWidth_m, random).friction_angle_rad - soil.mean.friction_angle_rad;
    sum += off;
    squares += off * off;
  }
  const double five_sigma = 5 * 2 * kDegree / std::sqrt(kDraws);
  EXPECT_NEAR(sum / kDraws, 0, five_sigma);
  EXPECT_NEAR(std::sqrt(squares / kDraws), 2 * kDegree, five_sigma);
}

TEST(SoilDraw, EveryDrawIsValid) {
  UncertainSoil soil{.mean = firm_regolith()};
  for (const SoilParameter& parameter : soil_parameters()) {
    soil.standard_deviation.*parameter.member = soil.mean.*parameter.member;  // often below 0
  }
  std::mt19937_64 random(3);
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(rejected_field(draw(soil, kWidth_m, random)), "");
}

TEST(SoilDraw, EveryDrawResistsTheSinkageOfTheWheel) {
  UncertainSoil soil{.mean = firm_regolith()};
  soil.mean.kc = 280;
  soil.mean.kphi = 2000;
  soil.standard_deviation.kc = 700;
  soil.standard_deviation.kphi = 2000;
  std::mt19937_64 random(3);
  for (int i = 0; i < 1000; ++i) {
    EXPECT_TRUE(resists_sinkage(draw(soil, kWidth_m, random), kWidth_m));
  }
}

TEST(SoilDraw, NumbersThatAreNeverValidAreAnError) {
  UncertainSoil soil{.mean = firm_regolith()};
  soil.mean.density_kgpm3 = -1e6;
  soil.standard_deviation.density_kgpm3 = 1;
  std::mt19937_64 random(1);
  EXPECT_THROW(draw(soil, kWidth_m, random), InputError);
}

}  // namespace
}  // namespace regoplan
