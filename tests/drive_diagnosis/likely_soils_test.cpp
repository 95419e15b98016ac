// Soils that may well lie where the map says another.
#include "drive_diagnosis/fit/likely_soils.h"

#include <gtest/gtest.h>

#include <cmath>

#include "terramech/basics/angles.h"
#include "tests/terramech/named_soils.h"

namespace regoplan {
namespace {

/// Known as well as tests of one soil know it.
UncertainSoil regolith() {
  UncertainSoil soil{.mean = named_soils::simulant_2007()};
  soil.standard_deviation = {.cohesion_pa = 50,
                             .friction_angle_rad = 2 * kDegree,
                             .kc = 350,
                             .kphi = 2e5,
                             .density_kgpm3 = 50,
                             .kx0_m = 0.0045};
  return soil;
}

Soil other(std::size_t difference) {
  const UncertainSoil here = regolith();
  return deviating(here, differences_among_soils(here).at(difference));
}

TEST(DifferencesAmongSoils, ReachTheSoilsOfOtherPlacesWithinTwoOrThree) {
  EXPECT_NEAR(std::log(regolith().mean.kphi / other(0).kphi), 1.5, 1e-9);  // two decades: three
  EXPECT_NEAR(std::log(regolith().mean.kc / other(0).kc), 1.5, 1e-9);
  EXPECT_NEAR(other(1).cohesion_pa, 800 / std::exp(1), 1e-9);
  EXPECT_NEAR(other(2).friction_angle_rad, 31.2 * kDegree, 1e-9);
  EXPECT_NEAR(other(3).density_kgpm3, 1450, 1e-9);
  EXPECT_NEAR(other(4).kx0_m, 0.036 * std::exp(0.4), 1e-9);
}

TEST(DifferencesAmongSoils, AreFoundWhereAMapTellsNoSpreadOfStrengthAndBearing) {
  UncertainSoil soil = regolith();
  soil.standard_deviation = {.density_kgpm3 = 50};
  const Soil weaker = deviating(soil, differences_among_soils(soil).at(0));
  EXPECT_NEAR(std::log(soil.mean.kphi / weaker.kphi), 1.5, 1e-9);
  const Soil looser = deviating(soil, differences_among_soils(soil).at(2));
  EXPECT_NEAR(looser.friction_angle_rad, 31.2 * kDegree, 1e-9);
}

TEST(EstimatedSoils, KeepWhatAMapTellsExactly) {
  UncertainSoil soil = regolith();
  soil.standard_deviation.kphi = 0;
  SoilNumbers all_known{};
  all_known.fill(1);
  const auto soils = estimated_soils({{"here", "", soil}}, {}, {all_known}, {true});
  EXPECT_EQ(soils[0].soil.mean.kphi, soil.mean.kphi);
  EXPECT_EQ(soils[0].soil.standard_deviation.kphi, 0);
  EXPECT_NEAR(soils[0].soil.standard_deviation.cohesion_pa, 50, 1e-9);
}

TEST(DifferencesAmongSoils, AreEachOfOneThingAlone) {
  EXPECT_EQ(other(0).friction_angle_rad, regolith().mean.friction_angle_rad);
  EXPECT_EQ(other(2).kphi, regolith().mean.kphi);
  EXPECT_EQ(other(2).cohesion_pa, regolith().mean.cohesion_pa);
}

TEST(DifferencesAmongSoils, AreTheSameSoilsHoweverWellTheMapKnowsItsOwn) {
  UncertainSoil known_better = regolith();
  known_better.standard_deviation.friction_angle_rad /= 4;
  const Soil there = deviating(known_better, differences_among_soils(known_better).at(2));
  EXPECT_NEAR(there.friction_angle_rad, other(2).friction_angle_rad, 1e-9);
}

}  // namespace
}  // namespace regoplan
