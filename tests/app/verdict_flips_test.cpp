#include "app/diagnose_drive/verdict_flips.h"

#include <gtest/gtest.h>

#include "tests/app/flat_map.h"
#include "tests/terramech/lunar_soil.h"

namespace regoplan {
namespace {

/// Flat ground of one firm soil.
TerrainMap flat_firm_map() {
  SoilCatalogue soils{
      .soils = {{"firm", "assumed", {.mean = firm_regolith()}}}, .classes = {}, .unmapped = 0};
  return {flat_elevation(), {}, std::move(soils), {}};
}

/// Driven east across it at 1 m/s, in windows of 2 s.
struct Driven {
  Driven() {
    setup.vehicle = preset_vehicle("lrv");
    setup.gravity_mps2 = 1.62;
    for (int i = 0; i < 14; ++i) {
      diagnosis.windows.push_back({.start_s = 2.0 * i,
                                   .end_s = 2.0 * (i + 1),
                                   .x_m = 7 + 2.0 * i,
                                   .y_m = 20,
                                   .speed_mps = 1,
                                   .forward_mps = 1});
    }
    diagnosis.effects = VehicleEffects{.soils = setup.map.soils()};
  }

  std::vector<VerdictFlip> flips() const {
    return verdict_flips(setup, default_limits(*setup.vehicle), diagnosis, 1, 2);
  }

  DriveSetup setup{.map = flat_firm_map(), .vehicle = {}};
  DriveDiagnosis diagnosis;
};

TEST(VerdictFlips, ThereAreNoneWhereNothingWasFound) {
  EXPECT_TRUE(Driven().flips().empty());
}

TEST(VerdictFlips, AZoneInWhichWheelsSinkTooDeepFlipsWhereItWasDriven) {
  Driven driven;
  UncertainSoil soft{.mean = driven.setup.map.soils()[0].soil.mean};
  soft.mean.kphi = 1.5e4;
  soft.mean.kc = 0;
  driven.diagnosis.effects->found.push_back(
      {.id = "soil_zone",
       .zone = SoilZoneFound{
           .first = 4, .last = 8, .starts_s = 8, .ends_s = 18, .soil = 0, .estimate = soft}});
  const std::vector<VerdictFlip> flips = driven.flips();
  ASSERT_EQ(flips.size(), 1u);
  // The front axle is in it a window before its middle, the rear axle a window longer.
  EXPECT_EQ(flips[0].starts_s, 6);
  EXPECT_EQ(flips[0].ends_s, 20);
  EXPECT_EQ(flips[0].before, "");
  EXPECT_NE(flips[0].after, "");
}

TEST(VerdictFlips, ALimitThatBreaksBetweenTheMiddlesOfWindowsFlips) {
  // A strip that no wheel is on in the middle of any window: a mean of the window keeps all limits.
  constexpr double kFrom_m = 8.4, kTo_m = 9.6, kCell_m = 0.2;
  Driven driven;
  const UncertainSoil firm = driven.setup.map.soils()[0].soil;
  UncertainSoil soft = firm;
  soft.mean.kphi = 1.5e4;
  soft.mean.kc = 0;
  const ElevationRaster elevation = driven.setup.map.elevation();
  ClassRaster classes{.frame = elevation.frame, .code = {}};
  classes.frame.columns =
      static_cast<int>(elevation.frame.columns * elevation.frame.cell_width_m / kCell_m);
  classes.frame.cell_width_m = kCell_m;
  for (int row = 0; row < classes.frame.rows; ++row) {
    for (int column = 0; column < classes.frame.columns; ++column) {
      const double x_m = classes.frame.west_m + (column + 0.5) * kCell_m;
      classes.code.push_back(x_m > kFrom_m && x_m < kTo_m);
    }
  }
  driven.setup.map = {elevation,
                      classes,
                      SoilCatalogue{.soils = {{"firm", "assumed", firm}, {"soft", "assumed", soft}},
                                    .classes = {{0, 0}, {1, 1}},
                                    .unmapped = {}},
                      {}};
  driven.diagnosis.effects->soils = {{"firm", "assumed", firm}, {"soft", "told", firm}};
  const std::vector<VerdictFlip> flips = driven.flips();
  ASSERT_FALSE(flips.empty());
  EXPECT_NE(flips[0].before, "");
  EXPECT_EQ(flips[0].after, "");
  EXPECT_LE(flips[0].starts_s, 2);
  EXPECT_LE(flips.back().ends_s, 6);
}

TEST(VerdictFlips, AZoneThatFewDrawsBearFlipsThoughItsMeanWould) {
  Driven driven;
  UncertainSoil doubtful{.mean = driven.setup.map.soils()[0].soil.mean};
  doubtful.mean.kphi = 6e4;
  doubtful.standard_deviation.kphi = 6e4;  // truncated at 0: some draws bear next to nothing
  doubtful.mean.kc = 0;
  driven.diagnosis.effects->found.push_back(
      {.id = "soil_zone",
       .zone = SoilZoneFound{
           .first = 4, .last = 8, .starts_s = 8, .ends_s = 18, .soil = 0, .estimate = doubtful}});
  const std::vector<VerdictFlip> flips = driven.flips();
  ASSERT_EQ(flips.size(), 1u);
  EXPECT_NE(flips[0].after.find("% of the draws"), std::string::npos) << flips[0].after;
}

}  // namespace
}  // namespace regoplan
