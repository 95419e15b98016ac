#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "terramech/vehicle/vehicle_dynamics.h"
#include "tests/terramech/lunar_soil.h"

namespace regoplan {

/// A vehicle that moves on a plane of one soil.
struct Driving {
  VehicleOnSoil on;
  VehicleDynamics dynamics;

  explicit Driving(const std::string& preset, const Plane& plane = {},
                   const Soil& soil = firm_regolith())
      : on(preset, soil), dynamics(on.vehicle, on.soil_laws, plane, on.gravity_mps2) {}

  /// Under one control for a while; the test fails where a step does.
  StepResult drive(const VehicleState& from, const VehicleControl& control, double duration_s,
                   double step_s) const {
    StepResult result{.state = from, .strain = {}};
    for (int i = 0; i < std::lround(duration_s / step_s); ++i) {
      result = dynamics.step(result.state, control, step_s);
      EXPECT_TRUE(result.converged && result.on_known_ground) << "step " << i << " of " << step_s;
    }
    return result;
  }
};

inline double speed_of(const VehicleState& state) {
  return std::hypot(state.motion.vx_mps, state.motion.vy_mps);
}

inline double kinetic_energy_j(const Vehicle& vehicle, const VehicleState& state) {
  const BodyMotion& v = state.motion;
  return (vehicle.mass_kg * (v.vx_mps * v.vx_mps + v.vy_mps * v.vy_mps) +
          vehicle.yaw_inertia_kgm2 * v.yaw_rate_rad_s * v.yaw_rate_rad_s) /
         2;
}

inline void expect_mirrored(const VehicleState& left, const VehicleState& right, double tolerance) {
  EXPECT_NEAR(left.x_m, right.x_m, tolerance);
  EXPECT_NEAR(left.y_m, -right.y_m, tolerance);
  EXPECT_NEAR(left.yaw_rad, -right.yaw_rad, tolerance);
  EXPECT_NEAR(left.motion.vx_mps, right.motion.vx_mps, tolerance);
  EXPECT_NEAR(left.motion.vy_mps, -right.motion.vy_mps, tolerance);
  EXPECT_NEAR(left.motion.yaw_rate_rad_s, -right.motion.yaw_rate_rad_s, tolerance);
}

inline constexpr double kRounding = 1e-12;

}  // namespace regoplan
