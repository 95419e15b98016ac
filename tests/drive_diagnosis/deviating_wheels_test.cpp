// The wheel on soils that lie off the map's.
#include "drive_diagnosis/comparison/deviating_wheels.h"

#include <gtest/gtest.h>

#include "tests/terramech/named_soils.h"

namespace regoplan {
namespace {

std::vector<MapSoil> one_soil() {
  UncertainSoil soil{.mean = named_soils::simulant_2007()};
  soil.standard_deviation.kphi = 2e5;
  return {{.name = "simulant", .source = {}, .soil = soil}};
}

TEST(DeviatingWheels, AreMadeOncePerSoil) {
  const std::vector<MapSoil> soils = one_soil();
  const Wheel wheel{.radius_m = 0.09, .width_m = 0.11};
  const DeviatingWheels wheels(soils, wheel, 9.81);
  SoilNumbers firmer{};
  firmer.fill(1);
  const auto as_mapped = wheels.on(0, {}), on_firmer = wheels.on(0, firmer);
  EXPECT_EQ(wheels.on(0, {}), as_mapped);
  EXPECT_EQ(wheels.on(0, firmer), on_firmer);
  const WheelMotion rolling = motion_at(0.2, 0);
  EXPECT_LT(on_firmer->forces(50, rolling).sinkage_m, as_mapped->forces(50, rolling).sinkage_m);
}

}  // namespace
}  // namespace regoplan
