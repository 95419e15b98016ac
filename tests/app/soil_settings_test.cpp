#include "app/settings/soil_settings.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

#include "tests/error_text.h"
#include "tests/terramech/named_soils.h"

namespace regoplan {
namespace {

constexpr const char* kSoils = R"(classes: {1: sand, 2: firm, 7: sand}
unmapped: firm
soils:
  sand:
    source: 'a paper: table 2'
    cohesion_pa: {mean: 800, std: 50}
    friction_angle_deg: {mean: 37.2, std: 1.5}
    kc: 1.37e3
    kphi: 8.14e5
    n: 1
    a0: .40
    a1: .15
    lambda: .9
    density_kgpm3: 1600
    kx0_m: .036
    ky0_m: .013
  firm:
    source: measured
    cohesion_pa: 1000
    friction_angle_deg: 40
    kc: 1.37e3
    kphi: 2.0e6
    n: 1
    a0: .40
    a1: .15
    lambda: .9
    density_kgpm3: 1600
    kx0_m: .036
    kx1_m: .043
    ky0_m: .013
    ky1_m: .020
    c0_m: .01
)";

SoilCatalogue catalogue(const std::string& yaml,
                        WheelVariant variant = WheelVariant::kIshigami2007) {
  return read_soil_catalogue(parse_settings(yaml, "soils.yaml"), variant);
}

std::string soils_error(const std::string& from, const std::string& to) {
  return error_text([&] { catalogue(replaced(kSoils, from, to)); });
}

TEST(SoilSettings, NumbersAreHeldInSiAndRadians) {
  const SoilCatalogue soils = catalogue(kSoils);
  ASSERT_EQ(soils.soils.size(), 2);
  const MapSoil& sand = soils.soils[0];
  EXPECT_EQ(sand.name, "sand");
  EXPECT_EQ(sand.source, "a paper: table 2");
  EXPECT_DOUBLE_EQ(sand.soil.mean.friction_angle_rad, 37.2 * std::numbers::pi / 180);
  EXPECT_DOUBLE_EQ(sand.soil.standard_deviation.friction_angle_rad, 1.5 * std::numbers::pi / 180);
  EXPECT_EQ(sand.soil.mean.kphi, 8.14e5);
  EXPECT_EQ(sand.soil.standard_deviation.kphi, 0);
  EXPECT_EQ(sand.soil.mean.kx1_m, 0);
}

TEST(SoilSettings, ClassesNameSoilsAndUnmappedIsForbiddenUnlessSaid) {
  const SoilCatalogue soils = catalogue(kSoils);
  const std::vector<std::pair<std::int32_t, int>> classes{{1, 0}, {2, 1}, {7, 0}};
  EXPECT_EQ(soils.classes, classes);
  EXPECT_EQ(soils.unmapped, 1);
  EXPECT_FALSE(catalogue(replaced(kSoils, "unmapped: firm", "unmapped: forbidden")).unmapped);
  EXPECT_FALSE(catalogue(replaced(kSoils, "unmapped: firm\n", "")).unmapped);
}

TEST(SoilSettings, WrittenSoilsReadBackBitForBit) {
  const SoilCatalogue soils = catalogue(kSoils);
  const SoilCatalogue again = catalogue(soil_catalogue_text(soils));
  ASSERT_EQ(again.soils.size(), soils.soils.size());
  EXPECT_EQ(again.classes, soils.classes);
  EXPECT_EQ(again.unmapped, soils.unmapped);
  for (std::size_t i = 0; i < soils.soils.size(); ++i) {
    EXPECT_EQ(again.soils[i].name, soils.soils[i].name);
    EXPECT_EQ(again.soils[i].source, soils.soils[i].source);
    for (const SoilParameter& parameter : soil_parameters()) {
      EXPECT_EQ(again.soils[i].soil.mean.*parameter.member,
                soils.soils[i].soil.mean.*parameter.member)
          << parameter.name;
      EXPECT_EQ(again.soils[i].soil.standard_deviation.*parameter.member,
                soils.soils[i].soil.standard_deviation.*parameter.member)
          << parameter.name;
    }
  }
}

TEST(SoilSettings, EveryNumberOutOfItsRangeIsAnErrorWithItsLine) {
  for (const SoilParameter& parameter : soil_parameters()) {
    const std::string key = "    " + std::string(parameter.name) + ": ";
    std::string yaml = kSoils;
    const std::size_t firm = yaml.find("  firm:");
    const std::size_t at = yaml.find(key, firm);
    ASSERT_NE(at, std::string::npos) << key;
    const std::size_t end = yaml.find('\n', at);
    yaml.replace(at, end - at, key + "1e13");
    const auto line = 1 + std::count(yaml.begin(), yaml.begin() + static_cast<long>(at), '\n');
    const std::string text = error_text([&] { catalogue(yaml); });
    EXPECT_TRUE(text.starts_with("soils.yaml:" + std::to_string(line) + ": soils.firm." +
                                 std::string(parameter.name) + ": 1e13 is not valid (allowed: "))
        << text;
  }
}

TEST(SoilSettings, WhatCannotBeASoilIsAnError) {
  EXPECT_EQ(soils_error("    kphi: 8.14e5\n", ""), "soils.yaml:4: soils.sand: kphi is missing");
  EXPECT_EQ(soils_error("    kc: 1.37e3\n", "    kc: 1.37e3\n    stickiness: 3\n").substr(0, 48),
            "soils.yaml:9: soils.sand.stickiness: unknown key");
  EXPECT_EQ(soils_error("std: 50", "std: -1"),
            "soils.yaml:6: soils.sand.cohesion_pa.std: -1 is not valid (allowed: at least 0)");
  EXPECT_EQ(soils_error(", std: 50", ""), "soils.yaml:6: soils.sand.cohesion_pa: std is missing");
  EXPECT_NE(soils_error("{1: sand", "{1: gravel"), "");
  EXPECT_NE(soils_error("{1: sand", "{one: sand"), "");
  EXPECT_NE(soils_error("{1: sand, 2: firm", "{1: sand, 01: firm"), "");
  EXPECT_NE(soils_error("unmapped: firm", "unmapped: gravel"), "");
  EXPECT_NE(soils_error("  sand:\n", "  forbidden:\n"), "");
  EXPECT_EQ(
      soils_error("a1: .15\n    lambda: .9\n    density_kgpm3: 1600\n    kx0_m: .036\n    kx1",
                  "a1: .6\n    lambda: .9\n    density_kgpm3: 1600\n    kx0_m: .036\n    kx1"),
      "soils.yaml:25: soils.firm.a1: 0.6 is not valid (allowed: 0 < a0 + a1 s < 1 for every "
      "slip s from -1 to 1)");
}

TEST(SoilSettings, SlipSinkageIsRequiredByThePapersOwnVariantOnly) {
  EXPECT_EQ(error_text([] { catalogue(kSoils, WheelVariant::kYoshida2004); }),
            "soils.yaml:4: soils.sand: c0_m is missing");
}

TEST(SoilSettings, TheSoilsThatComeWithTheProgramAreValid) {
  for (const char* folder : {"demo", "marias_pass"}) {
    const std::string file =
        std::string(REGOPLAN_SOURCE_DIR "/scenarios/") + folder + "/soils.yaml";
    EXPECT_GE(read_soil_catalogue(read_settings(file), WheelVariant::kIshigami2007).soils.size(),
              3);
  }
}

TEST(SoilSettings, TheSoilsOfTheTestsAreThoseOfTheScenarios) {
  int compared = 0;
  for (const char* scenario : {"demo", "marias_pass"}) {
    const std::filesystem::path file =
        std::filesystem::path(REGOPLAN_SOURCE_DIR) / "scenarios" / scenario / "soils.yaml";
    const SoilCatalogue read =
        read_soil_catalogue(read_settings(file), WheelVariant::kIshigami2007);
    for (const named_soils::NamedSoil& named : named_soils::shipped()) {
      for (const MapSoil& soil : read.soils) {
        if (soil.name != named.name) continue;
        ++compared;
        for (const SoilParameter& parameter : soil_parameters()) {
          EXPECT_DOUBLE_EQ(soil.soil.mean.*parameter.member, named.soil.*parameter.member)
              << soil.name << " " << parameter.name;
        }
      }
    }
  }
  EXPECT_EQ(compared, 6);
}

TEST(SoilSettings, NumbersThatLookLikeAnotherUnitAreToldSoilBySoil) {
  const auto doubts = [](const std::string& from, const std::string& to) {
    const SettingsNode node = parse_settings(replaced(kSoils, from, to), "soils.yaml");
    const auto all = doubtful_units(node, read_soil_catalogue(node, WheelVariant::kIshigami2007));
    return all.size() == 1 ? all[0] : fmt::format("{} sentences", all.size());
  };
  EXPECT_EQ(doubts("source: measured", "source: measured"), "0 sentences");
  EXPECT_EQ(doubts("cohesion_pa: 1000", "cohesion_pa: 0"), "0 sentences");
  EXPECT_EQ(doubts("{mean: 37.2, std: 1.5}", "{mean: 0.65, std: 0.03}"),
            "soils.yaml:7: soils.sand.friction_angle_deg: 0.65 is small for a soil (usual: from 2 "
            "on); suspected: radians");
  EXPECT_EQ(doubts("{mean: 37.2, std: 1.5}", "{mean: 0, std: 0}"), "0 sentences");
  EXPECT_EQ(doubts("cohesion_pa: 1000", "cohesion_pa: 1"),
            "soils.yaml:19: soils.firm.cohesion_pa: 1 is small for a soil (usual: from 10 on); "
            "suspected: kPa");
  EXPECT_EQ(doubts("kphi: 8.14e5", "kphi: 814"),
            "soils.yaml:9: soils.sand.kphi: 814 is small for a soil (usual: from 10000 on); "
            "suspected: kN/m^(n+2)");
  EXPECT_EQ(doubts("density_kgpm3: 1600", "density_kgpm3: 1.6"),
            "soils.yaml:14: soils.sand.density_kgpm3: 1.6 is small for a soil (usual: from 100 "
            "on); suspected: g/cm3");
  EXPECT_EQ(doubts("kx0_m: .036", "kx0_m: 3.6"),
            "soils.yaml:15: soils.sand.kx0_m: 3.6 is large for a soil (usual: up to 0.3); "
            "suspected: cm or mm");
}

}  // namespace
}  // namespace regoplan
