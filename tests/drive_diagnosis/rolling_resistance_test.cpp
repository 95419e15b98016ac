// What a wheel that pulls nothing takes to roll, on one soil and on another.
#include "drive_diagnosis/rolling_resistance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "terramech/parameters/vehicle.h"
#include "terramech/wheel/wheel_model.h"
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

TEST(RollingResistance, IsTheTorqueOfAWheelThatPullsNothing) {
  const Vehicle lrv = preset_vehicle("lrv");
  for (const auto& [name, soil, gravity_mps2] : named_soils::shipped()) {
    const double load_n = lrv.mass_kg * gravity_mps2 / 4;
    const WheelModel wheel(
        WheelModelSpec{.wheel = lrv.wheel, .soil = soil, .gravity_mps2 = gravity_mps2});
    WheelForces rolling = wheel.forces(load_n, motion_at(-0.3, 0));
    for (double slip = -0.3; slip < 0.9; slip += 1e-3) {
      const WheelForces at = wheel.forces(load_n, motion_at(slip, 0));
      if (std::abs(at.fx_n) < std::abs(rolling.fx_n)) rolling = at;
    }
    EXPECT_NEAR(rolling_resistance(lrv, gravity_mps2, soil),
                rolling.torque_nm / (lrv.wheel.radius_m * load_n), 2e-3)
        << name;
  }
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
