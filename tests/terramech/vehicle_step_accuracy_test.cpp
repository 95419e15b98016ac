#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "terramech/basics/angles.h"
#include "tests/terramech/driving.h"

namespace regoplan {
namespace {

/// Where an S at the given step ends: rim speed and steering ramp all the way, as smooth as
/// controls get. At 0.8 s the steering turns back.
VehicleState end_of_s(const Driving& rover, double speed_mps, double step_s) {
  const double rate = rover.on.vehicle.curvature_rate_max_1pms;
  VehicleState state = rover.dynamics.rolling_state(0, 0, 0, speed_mps);
  const double faster = 2 * rover.on.vehicle.speed_max_mps;
  state = rover.drive(state, {faster, 10 * rate}, 0.8, step_s).state;
  return rover.drive(state, {faster, -10 * rate}, 1.6, step_s).state;
}

TEST(VehicleSteps, IsOfSecondOrderInTheStep) {
  for (const double speed : {1.0, 3.0}) {
    const Driving rover("lrv", Plane{0.1, -0.15});
    const VehicleState exact = end_of_s(rover, speed, 0.8 / 512);
    const auto error = [&](double step_s) {
      const VehicleState state = end_of_s(rover, speed, step_s);
      return std::hypot(state.x_m - exact.x_m, state.y_m - exact.y_m);
    };
    const double coarse = error(0.8 / 8), middle = error(0.8 / 16), fine = error(0.8 / 32);
    EXPECT_LT(coarse, 0.004 * 2.4 * speed);
    EXPECT_GT(coarse / middle, 3) << speed;
    EXPECT_GT(middle / fine, 3) << speed;
    EXPECT_LT(middle / fine, 6) << speed;
  }
}

TEST(VehicleSteps, HoldsLongStepsAtCreepingSpeed) {
  for (const std::string& name : preset_vehicle_names()) {
    const Driving rover(name, Plane{0.05, 0.1});
    const double k = 0.3 * rover.on.vehicle.curvature_max_1pm;
    for (const double speed : {0.01, 0.05}) {
      if (speed > rover.on.vehicle.speed_max_mps) continue;
      const VehicleState start = rover.dynamics.rolling_state(0, 0, 0, speed);
      const VehicleState fine = rover.drive(start, {speed, k}, 60, 0.05).state;
      for (const double step_s : {0.25, 0.5, 1.0}) {
        const VehicleState coarse = rover.drive(start, {speed, k}, 60, step_s).state;
        EXPECT_NEAR(coarse.x_m, fine.x_m, 0.01 * 60 * speed) << name << speed << ' ' << step_s;
        EXPECT_NEAR(coarse.y_m, fine.y_m, 0.01 * 60 * speed) << name << speed << ' ' << step_s;
        EXPECT_NEAR(coarse.yaw_rad, fine.yaw_rad, 0.01) << name << speed << ' ' << step_s;
      }
    }
  }
}

/// Largest slip angle of a wheel of a vehicle that is set rolling straight along a side slope.
double largest_slip_angle_rad(const Driving& rover, double speed_mps, double step_s) {
  VehicleState state = rover.dynamics.rolling_state(0, 0, 0, speed_mps);
  double largest_rad = 0;
  for (int i = 0; i < std::lround(2 / step_s); ++i) {
    const StepResult result = rover.drive(state, {speed_mps, 0}, step_s, step_s);
    largest_rad = std::max(largest_rad, std::abs(result.strain.slip_angle_rad));
    state = result.state;
  }
  return largest_rad;
}

/// Slow vehicles take up their slip angle in milliseconds. A step that is longer ends near what
/// they settle to: extrapolated beyond it, forces that saturate would not bring them back.
TEST(VehicleSteps, SlidesNoFartherInLongStepsThanInShortOnes) {
  for (const std::string& name : preset_vehicle_names()) {
    for (const double slope_deg : {10.0, 18.0}) {
      const Driving rover(name, Plane{0, std::tan(slope_deg * kDegree)});
      for (const double speed_mps : {0.01, 0.04, 0.2, 1.0}) {
        if (speed_mps > rover.on.vehicle.speed_max_mps) continue;
        const double fine_rad = largest_slip_angle_rad(rover, speed_mps, 0.002);
        for (const double step_s : {0.02, 0.05, 0.1, 0.25}) {
          EXPECT_LT(largest_slip_angle_rad(rover, speed_mps, step_s), fine_rad + 0.02)
              << name << ", " << slope_deg << " deg, " << speed_mps << " m/s, " << step_s << " s";
        }
      }
    }
  }
}

TEST(VehicleSteps, ASlalomOfAMinuteNeedsNoFinerSteps) {
  for (const double speed : {0.3, 1.0, 3.0}) {
    const Driving rover("lrv");
    const auto slalom = [&](double step_s) {
      VehicleState state = rover.dynamics.rolling_state(0, 0, 0, speed);
      for (int turn = 0; turn < 12; ++turn) {
        state = rover.drive(state, {speed, turn % 2 == 0 ? 0.05 : -0.05}, 5, step_s).state;
      }
      return state;
    };
    const VehicleState coarse = slalom(0.1), fine = slalom(0.05);
    EXPECT_LT(std::hypot(coarse.x_m - fine.x_m, coarse.y_m - fine.y_m), 0.5e-3 * 60 * speed)
        << speed;
  }
}

}  // namespace
}  // namespace regoplan
