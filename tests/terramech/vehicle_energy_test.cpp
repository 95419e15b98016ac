#include <gtest/gtest.h>

#include <cmath>

#include "tests/terramech/driving.h"

namespace regoplan {
namespace {

TEST(VehicleEnergy, BrakesToAStandstillAndStaysThere) {
  for (const double step_s : {0.02, 0.1, 0.5}) {
    for (const double speed : {2.0, -2.0}) {
      const Driving rover("lrv");
      const VehicleState start = rover.dynamics.rolling_state(0, 0, 0, speed);
      const VehicleState stopped = rover.drive(start, {0, 0}, 10, step_s).state;
      EXPECT_EQ(stopped.rim_speed_mps, 0);
      EXPECT_LT(speed_of(stopped), 1e-4) << step_s;
      const VehicleState later = rover.drive(stopped, {0, 0}, 10, step_s).state;
      EXPECT_LT(std::hypot(later.x_m - stopped.x_m, later.y_m - stopped.y_m), 1e-3) << step_s;
      // v^2 / 2a of the rims; braking, the vehicle goes faster than they turn.
      EXPECT_GT(std::abs(stopped.x_m), 4 / (2 * 0.3)) << step_s;
      EXPECT_LT(std::abs(stopped.x_m), 1.08 * 4 / (2 * 0.3)) << step_s;
    }
  }
}

TEST(VehicleEnergy, LockedWheelsNeverGainEnergyOnTheFlat) {
  const Driving rover("lrv");
  constexpr double kRounding_j = 1e-12;
  for (const double step_s : {0.02, 0.2}) {
    for (const BodyMotion& slide : {BodyMotion{2, 0, 0}, BodyMotion{1, 2, 0}, BodyMotion{0, 0, 2},
                                    BodyMotion{-1, 0.5, -3}, BodyMotion{0.01, 0.02, 0.1}}) {
      VehicleState state = rover.dynamics.rolling_state(0, 0, 0, 0, 0.2);
      state.motion = slide;
      double energy = kinetic_energy_j(rover.on.vehicle, state);
      for (int i = 0; i < 100; ++i) {
        state = rover.drive(state, {0, 0.2}, step_s, step_s).state;
        const double now = kinetic_energy_j(rover.on.vehicle, state);
        EXPECT_LE(now, energy + kRounding_j) << i;
        energy = now;
      }
    }
  }
}

TEST(VehicleEnergy, LockedWheelsHoldOnAGentleSlope) {
  const double gentle = std::tan(8 * kDegree);
  for (const Plane& plane : {Plane{gentle, 0}, Plane{-gentle, 0}, Plane{0, gentle}}) {
    const Driving rover("lrv", plane);
    const VehicleState start = rover.dynamics.rolling_state(0, 0, 0, 0);
    const VehicleState later = rover.drive(start, {0, 0}, 60, 0.5).state;
    EXPECT_LT(speed_of(later), 1e-3);
    EXPECT_LT(std::hypot(later.x_m, later.y_m), 0.06);
  }
}

TEST(VehicleEnergy, LockedWheelsSlideWhereTheSlopeIsBeyondFriction) {
  const Driving rover("lrv", Plane{std::tan(42 * kDegree), 0});
  const VehicleState later =
      rover.drive(rover.dynamics.rolling_state(0, 0, 0, 0), {0, 0}, 5, 0.1).state;
  EXPECT_LT(later.motion.vx_mps, -0.3);
}

TEST(VehicleEnergy, DrivingTakesTheEnergyThatItGainsAndTheSoilTakes) {
  const Driving rover("lrv");
  VehicleState state = rover.dynamics.rolling_state(0, 0, 0, 0);
  double spent_j = 0;
  for (int i = 0; i < 100; ++i) {
    const StepResult next = rover.drive(state, {3, 0}, 0.1, 0.1);
    EXPECT_GE(next.drive_energy_j, 0);
    spent_j += next.drive_energy_j;
    state = next.state;
  }
  const double gained_j = kinetic_energy_j(rover.on.vehicle, state);
  EXPECT_GT(spent_j, gained_j);
  EXPECT_LT(spent_j, 2 * gained_j);
}

}  // namespace
}  // namespace regoplan
