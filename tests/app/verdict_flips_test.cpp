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
    return verdict_flips(setup, default_limits(*setup.vehicle), diagnosis, 1);
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
