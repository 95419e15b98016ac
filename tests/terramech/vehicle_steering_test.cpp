#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/terramech/driving.h"

namespace regoplan {
namespace {

TEST(VehicleSteering, ACrabbingVehicleMovesAsideWithoutTurning) {
  Vehicle vehicle = preset_vehicle("tohoku");
  vehicle.steering = Steering::kCrab;
  const VehicleOnSoil on(vehicle, firm_regolith(), kEarth_mps2);
  const VehicleDynamics dynamics(on.vehicle, on.soil_laws, Plane{}, on.gravity_mps2);
  VehicleState state = dynamics.rolling_state(0, 0, 0, 0);
  for (int i = 0; i < 200; ++i) {
    state = dynamics.step(state, {.speed_target_mps = 0.05, .crab_target_rad = 0.5}, 0.1).state;
  }
  EXPECT_EQ(state.crab_rad, 0.5);
  EXPECT_NEAR(std::atan2(state.motion.vy_mps, state.motion.vx_mps), 0.5, 1e-3);
  EXPECT_NEAR(state.yaw_rad, 0, 1e-3);
}

TEST(VehicleSteering, ASkidSteeredVehicleTurnsLessThanItsRimsCommand) {
  const VehicleOnSoil on(skid_steered(), firm_regolith(), kMoon_mps2);
  const VehicleDynamics dynamics(on.vehicle, on.soil_laws, Plane{}, on.gravity_mps2);
  VehicleState state = dynamics.rolling_state(0, 0, 0, 0.5);
  for (int i = 0; i < 100; ++i) {
    const StepResult next = dynamics.step(state, {0.5, 0.4}, 0.1);
    ASSERT_TRUE(next.converged) << i;
    state = next.state;
  }
  const double curvature = state.motion.yaw_rate_rad_s / speed_of(state);
  EXPECT_GT(curvature, 0.02);
  EXPECT_LT(curvature, 0.4);
}

TEST(VehicleSteering, TurnsOnTheSpot) {
  for (const Vehicle& vehicle : {preset_vehicle("curiosity"), skid_steered()}) {
    const VehicleOnSoil on(vehicle, firm_regolith(), kMoon_mps2);
    const VehicleDynamics dynamics(on.vehicle, on.soil_laws, Plane{}, on.gravity_mps2);
    const double top = vehicle.speed_max_mps, rate = 0.1 * top;
    VehicleState state = dynamics.rolling_state(0, 0, 0, 0.3 * top);
    const auto turn = [&](double target, double duration_s) {
      for (int i = 0; i < duration_s / 0.1; ++i) {
        const StepResult next =
            dynamics.step(state, {.speed_target_mps = top, .turn_rate_target_rad_s = target}, 0.1);
        ASSERT_TRUE(next.converged) << vehicle.name << i;
        state = next.state;
      }
    };
    turn(rate, 10);  // it stops first
    EXPECT_EQ(state.rim_speed_mps, 0) << vehicle.name;
    const VehicleState before = state;
    turn(rate, 20);
    // Wheels that do not steer are dragged sideways and slip much.
    const double turned = state.yaw_rad - before.yaw_rad;
    EXPECT_GT(turned, (vehicle.steering == Steering::kSkid ? 0.05 : 0.9) * rate * 20);
    EXPECT_LT(turned, 1.01 * rate * 20) << vehicle.name;
    EXPECT_LT(std::hypot(state.x_m - before.x_m, state.y_m - before.y_m), 0.1) << vehicle.name;
    turn(-rate, 60);
    EXPECT_LT(state.motion.yaw_rate_rad_s, 0) << vehicle.name;
  }
}

/// Beyond the slip at which wheels pull best, a turn on the spot balances like a pencil on its tip:
/// what moves ahead spins less, pulls more and moves on. So a long skid-steered vehicle that brakes
/// from a drive slides away, and one at rest turns where it stands.
TEST(VehicleSteering, ASymmetricVehicleTurnsOnTheSpotWithoutDrifting) {
  Vehicle stretched = skid_steered();
  for (WheelMount& wheel : stretched.wheels) wheel.x_m *= 2.5;
  for (const Vehicle& vehicle : {skid_steered(), stretched}) {
    for (const WheelAccuracy accuracy : {WheelAccuracy::kFast, WheelAccuracy::kExact}) {
      const VehicleOnSoil on(vehicle, firm_regolith(), kMoon_mps2, accuracy);
      const VehicleDynamics dynamics(on.vehicle, on.soil_laws, Plane{}, on.gravity_mps2);
      VehicleState state = dynamics.rolling_state(0, 0, 0, 0);
      double turned = 0;
      for (int i = 0; i < 400; ++i) {
        const StepResult next = dynamics.step(state, {.turn_rate_target_rad_s = 0.5}, 0.1);
        ASSERT_TRUE(next.converged) << i;
        turned += std::remainder(next.state.yaw_rad - state.yaw_rad, 2 * std::numbers::pi);
        state = next.state;
      }
      EXPECT_GT(turned, 3);
      EXPECT_LT(std::hypot(state.x_m, state.y_m), kRounding);
    }
  }
}

}  // namespace
}  // namespace regoplan
