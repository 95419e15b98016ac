#include "terramech/vehicle/faded_forces.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/terramech/lunar_soil.h"

namespace regoplan {
namespace {

TEST(FadedForces, VanishInProportionToTheSpeedAtRest) {
  EXPECT_EQ(Fade(0, 0).value, 0);
  EXPECT_NEAR(Fade(1e-3 * kStandstill_mps, 0).value, 1e-3, 1e-8);
  EXPECT_NEAR(Fade(0, -1e-3 * kStandstill_mps).value, 1e-3, 1e-8);
}

TEST(FadedForces, SlowRoversHaveThemWhole) {
  EXPECT_NEAR(Fade(0.03, 0.03).value, 1, 3e-4);
  EXPECT_NEAR(Fade(0.04, 0).value, 1, 4e-4);
  EXPECT_NEAR(Fade(1, 1).value, 1, 1e-6);
  const VehicleOnSoil on("lrv");
  const WheelMotion slow{0.035, 0.004, 0.04};
  const WheelForces whole = on.model.forces(300, slow), fading = faded(on.soil_laws[0], 300, slow);
  EXPECT_NEAR(fading.fx_n, whole.fx_n, 4e-4 * std::abs(whole.fx_n));
  EXPECT_NEAR(fading.fy_n, whole.fy_n, 4e-4 * std::abs(whole.fy_n));
  EXPECT_NEAR(fading.torque_nm, whole.torque_nm, 4e-4 * std::abs(whole.torque_nm));
}

TEST(FadedForces, TheSlopeIsThatOfTheValue) {
  constexpr double kStep_mps = 1e-9;
  for (const double speed : {1e-4, 1e-3, 3e-3, 0.04}) {
    const double slope =
        (Fade(speed + kStep_mps, 0).value - Fade(speed - kStep_mps, 0).value) / (2 * kStep_mps);
    EXPECT_NEAR(Fade(speed, 0).slope_per_speed * speed, slope, 1e-5 * (1 + slope)) << speed;
  }
}

}  // namespace
}  // namespace regoplan
