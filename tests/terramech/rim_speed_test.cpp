#include "terramech/vehicle/rim_speed.h"

#include <gtest/gtest.h>

#include "terramech/wheel/wheel_law.h"
#include "tests/terramech/lunar_soil.h"

namespace regoplan {
namespace {

TEST(RimSpeed, GivesTheWantedTorqueForwardAndBackward) {
  const VehicleOnSoil on("lrv");
  for (const double vx : {2.0, -2.0, 1e-3}) {
    for (const double share : {-0.2, 0.0, 0.05, 0.3}) {
      const double wanted = share * 300 * on.vehicle.wheel.radius_m;
      const auto torque = [&](double rim) {
        return on.model.forces(300, {vx, 0.1 * vx, rim}).torque_nm;
      };
      const double rim = rim_speed_at_torque(torque, wanted, vx, 1e-6);
      EXPECT_NEAR(torque(rim), wanted, 1e-4) << vx << ' ' << share;
    }
  }
}

TEST(RimSpeed, AFreeWheelTurnsALittleSlowerThanItsAxleMoves) {
  const VehicleOnSoil on("lrv");
  const auto torque = [&](double rim) { return on.model.forces(300, {1, 0, rim}).torque_nm; };
  const double rim = rim_speed_at_torque(torque, 0, 1, 1e-6);
  EXPECT_LT(rim, 1);
  EXPECT_GT(rim, 0.7);
}

TEST(RimSpeed, SpinsWhereTheSoilDoesNotHoldTheTorque) {
  const auto torque = [](double rim) { return std::tanh(rim); };
  EXPECT_GT(rim_speed_at_torque(torque, 2, 1, 1e-6), 50);
  EXPECT_LT(rim_speed_at_torque(torque, -2, 1, 1e-6), -50);
}

TEST(RimSpeed, FindsAJump) {
  const auto torque = [](double rim) { return rim < 0.3 ? -1.0 : 1.0; };
  EXPECT_NEAR(rim_speed_at_torque(torque, 0, 1, 1e-6), 0.3, 1e-9);
}

}  // namespace
}  // namespace regoplan
