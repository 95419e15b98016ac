// What a wheel that pulls nothing takes to roll, on one soil and on another.
#include "drive_diagnosis/rolling_resistance.h"

#include <gtest/gtest.h>

#include "terramech/parameters/vehicle.h"
#include "tests/terramech/named_soils.h"

namespace regoplan {
namespace {

Soil bearing(double kphi) {
  Soil soil = named_soils::simulant_2007();
  soil.kphi = kphi;
  return soil;
}

DriveEstimate added(const std::vector<Soil>& draws) {
  return added_resistance(preset_vehicle("lrv"), named_soils::kMoon_mps2, bearing(8e5),
                          bearing(1e5), draws);
}

TEST(AddedResistance, IsMoreWhereSoilBearsLess) {
  EXPECT_GT(added({bearing(1e5)}).value, 0.02);
}

TEST(AddedResistance, VariesAsTheSoilsThatMayLieThere) {
  EXPECT_EQ(added({bearing(1e5), bearing(1e5), bearing(1e5)}).std, 0);
  const double narrow = added({bearing(9e4), bearing(1e5), bearing(1.1e5)}).std;
  const double wide = added({bearing(5e4), bearing(1e5), bearing(2e5)}).std;
  EXPECT_GT(narrow, 0);
  EXPECT_GT(wide, 3 * narrow);
}

TEST(AddedResistance, IsNotTakenForUnknownAsFewOfThoseSoilsCarryNoWheel) {
  std::vector<Soil> draws;
  for (int i = 0; i < 60; ++i) draws.push_back(bearing(1e5 * (0.9 + 0.2 * i / 59)));
  const double all_carry = added(draws).std;
  draws[0] = draws[1] = bearing(300);
  EXPECT_NEAR(added(draws).std, all_carry, 0.2 * all_carry);
}

}  // namespace
}  // namespace regoplan
