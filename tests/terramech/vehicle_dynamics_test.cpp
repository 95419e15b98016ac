#include "terramech/vehicle/vehicle_dynamics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <span>

#include "terramech/margins/trim.h"
#include "tests/error_text.h"
#include "tests/terramech/driving.h"

namespace regoplan {
namespace {

TEST(VehicleDynamics, SpeedsUpFromStandstillToSteadyTrimStraightAhead) {
  for (const std::string& name : preset_vehicle_names()) {
    const Driving rover(name);
    const double top = rover.on.vehicle.speed_max_mps;
    const double time = top / rover.on.vehicle.acceleration_max_mps2 + 10;
    const VehicleState steady =
        rover.drive(rover.dynamics.rolling_state(0, 0, 0, 0), {top, 0}, time, time / 400).state;
    const ForceLine nothing{};
    const SteadyManoeuvre manoeuvre = rover.on.manoeuvre(0);
    const Trim trim = manoeuvre.trim(manoeuvre.solve_from_rolling(nothing).value(), nothing);
    EXPECT_NEAR(steady.rim_speed_mps / speed_of(steady), trim.drive_factor, 1e-4) << name;
    EXPECT_EQ(steady.motion.vy_mps, 0) << name;
    EXPECT_EQ(steady.yaw_rad, 0) << name;
  }
}

TEST(VehicleDynamics, ASteadyTurnIsTheTrimOfTheCurvatureItFollows) {
  for (const std::string& name : preset_vehicle_names()) {
    const Driving rover(name);
    const double speed = name == "lrv" ? 2 : rover.on.vehicle.speed_max_mps;
    const double commanded = name == "lrv" ? 0.08 : 0.5 * rover.on.vehicle.curvature_max_1pm;
    const VehicleState steady = rover
                                    .drive(rover.dynamics.rolling_state(0, 0, 0, speed, commanded),
                                           {speed, commanded}, 40, 0.1)
                                    .state;
    const double k = steady.motion.yaw_rate_rad_s / speed_of(steady);
    const double m = rover.on.vehicle.mass_kg;
    const ForceLine centripetal{
        .from = {.forward_n = 0, .left_n = m * k * speed_of(steady) * speed_of(steady)},
        .per_unit = {}};
    const SteadyManoeuvre manoeuvre = rover.on.manoeuvre(k);
    const auto rolling = manoeuvre.solve_from_rolling({});
    ASSERT_TRUE(rolling) << name;
    const auto there = manoeuvre.solve(*rolling, centripetal);
    ASSERT_TRUE(there) << name;
    const Trim trim = manoeuvre.trim(*there, centripetal);
    EXPECT_NEAR(std::atan2(steady.motion.vy_mps, steady.motion.vx_mps), trim.body_slip_angle_rad,
                1e-3)
        << name;
    EXPECT_NEAR(steady.rim_speed_mps / speed_of(steady), trim.drive_factor, 1e-3) << name;
    EXPECT_NEAR(commanded, trim.steer_curvature_1pm, 1e-2 * commanded) << name;
  }
}

TEST(VehicleDynamics, ClimbsDescendsAndTraversesAsTrimsDo) {
  const double slope = std::tan(12 * kDegree);
  const VehicleOnSoil on("lrv");
  const double normal = on.weight_n() * std::cos(12 * kDegree);
  const double pull = on.weight_n() * std::sin(12 * kDegree);
  const SteadyManoeuvre manoeuvre(on.vehicle, on.sharing, on.wheel_laws, 0, normal);
  for (const double up : {1.0, -1.0}) {
    const Driving rover("lrv", Plane{up * slope, 0});
    const VehicleState steady =
        rover.drive(rover.dynamics.rolling_state(0, 0, 0, 1), {1, 0}, 20, 0.1).state;
    const ForceLine line{.from = {.forward_n = up * pull, .left_n = 0}, .per_unit = {}};
    const Trim trim = manoeuvre.trim(manoeuvre.solve_from_rolling(line).value(), line);
    EXPECT_NEAR(1 / speed_of(steady), trim.drive_factor, 1e-3) << up;
  }
  // Across the slope a vehicle that steers straight drifts downhill as fast as the trim slips.
  const Driving rover("lrv", Plane{0, slope});
  VehicleState across = rover.dynamics.rolling_state(0, 0, 0, 1);
  across = rover.drive(across, {1, 0}, 3, 0.1).state;
  const ForceLine line{.from = {.forward_n = 0, .left_n = pull}, .per_unit = {}};
  const auto rolling = manoeuvre.solve_from_rolling({});
  const Trim trim = manoeuvre.trim(manoeuvre.solve(*rolling, line).value(), line);
  EXPECT_LT(trim.body_slip_angle_rad, 0);
  EXPECT_NEAR(std::atan2(across.motion.vy_mps, across.motion.vx_mps), trim.body_slip_angle_rad,
              0.1 * std::abs(trim.body_slip_angle_rad));
}

TEST(VehicleDynamics, FindsItsBalanceThroughStopsAndReversals) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> share(-1, 1);
  for (const char* name : {"lrv", "curiosity"}) {
    const VehicleOnSoil on(preset_vehicle(name), firm_regolith(), home_gravity_mps2(name),
                           WheelAccuracy::kFast);
    const double top = on.vehicle.speed_max_mps, lock = on.vehicle.curvature_max_1pm;
    for (int i = 0; i < 10; ++i) {
      const Plane plane{0.2 * share(random), 0.2 * share(random)};
      const VehicleDynamics dynamics(on.vehicle, on.soil_laws, plane, on.gravity_mps2);
      VehicleState state =
          dynamics.rolling_state(0, 0, 3 * share(random), 0.2 * top * share(random));
      for (int k = 0; k < 40; ++k) {
        const StepResult next =
            dynamics.step(state, {top * share(random), lock * share(random)}, 0.1);
        ASSERT_TRUE(next.converged) << name << i << ' ' << k;
        state = next.state;
        EXPECT_LT(speed_of(state), 1.5 * top) << name;
      }
    }
  }
}

TEST(VehicleDynamics, ControlsMoveAtTheirLimitedRates) {
  const Driving rover("lrv");
  const VehicleState start = rover.dynamics.rolling_state(0, 0, 0, 1);
  const VehicleState one = rover.dynamics.step(start, {5, 0.5}, 0.5).state;
  EXPECT_NEAR(one.rim_speed_mps, 1.15, 1e-12);
  EXPECT_NEAR(one.rim_acceleration_mps2, 0.3, 1e-12);
  EXPECT_NEAR(one.curvature_1pm, 0.5 * rover.on.vehicle.curvature_rate_max_1pms, 1e-12);
  const VehicleState there = rover.dynamics.step(start, {1.03, 0.01}, 0.5).state;
  EXPECT_EQ(there.rim_speed_mps, 1.03);
  EXPECT_EQ(there.curvature_1pm, 0.01);
  EXPECT_NEAR(there.rim_acceleration_mps2, 0.06, 1e-12);
}

TEST(VehicleDynamics, RefusesWhatCannotMove) {
  const VehicleOnSoil on("lrv");
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  const auto refused_for = [](const Vehicle& vehicle, std::span<const WheelLaw> laws,
                              double gravity_mps2) {
    const std::string text =
        error_text([&] { const VehicleDynamics no(vehicle, laws, Plane{}, gravity_mps2); });
    return text.substr(0, text.find_first_of(" :"));
  };
  EXPECT_EQ(refused_for(on.vehicle, on.soil_laws, on.gravity_mps2), "");
  EXPECT_EQ(refused_for(on.vehicle, {}, on.gravity_mps2), "soil_laws");
  for (const double nonsense : {-1.0, 0.0, kNaN}) {
    EXPECT_EQ(refused_for(on.vehicle, on.soil_laws, nonsense), "gravity_mps2");
    Vehicle vehicle = on.vehicle;
    vehicle.mass_kg = nonsense;
    EXPECT_EQ(refused_for(vehicle, on.soil_laws, on.gravity_mps2), "mass_kg");
    vehicle = on.vehicle;
    vehicle.yaw_inertia_kgm2 = nonsense;
    EXPECT_EQ(refused_for(vehicle, on.soil_laws, on.gravity_mps2), "yaw_inertia_kgm2");
    vehicle = on.vehicle;
    vehicle.wheel.radius_m = nonsense;
    EXPECT_EQ(refused_for(vehicle, on.soil_laws, on.gravity_mps2), "radius_m");
  }
  Vehicle vehicle = on.vehicle;
  vehicle.wheels.clear();
  EXPECT_EQ(refused_for(vehicle, on.soil_laws, on.gravity_mps2), "wheels");
}

TEST(VehicleDynamics, StopsShortOfUnknownGround) {
  const VehicleOnSoil on("lrv");
  const VehicleDynamics dynamics(
      on.vehicle, on.soil_laws,
      [](double x_m, double, double) {
        GroundPatch patch = patch_with(0, 0);
        patch.known = x_m < 1;
        return patch;
      },
      on.gravity_mps2);
  VehicleState state = dynamics.rolling_state(0, 0, 0, 1);
  StepResult result{.state = state, .strain = {}};
  for (int i = 0; i < 30 && result.on_known_ground; ++i) {
    result = dynamics.step(result.state, {1, 0}, 0.1);
  }
  EXPECT_FALSE(result.on_known_ground);
  EXPECT_GT(result.state.x_m, 0.8);
  EXPECT_LT(result.state.x_m, 1);
}

TEST(VehicleDynamics, TellsTheStrainOfItsWheels) {
  const Driving rover("lrv", Plane{std::tan(15 * kDegree), 0});
  const StepResult climbing =
      rover.drive(rover.dynamics.rolling_state(0, 0, 0, 1), {1, 0}, 10, 0.1);
  EXPECT_GT(climbing.strain.slip, 0.02);
  EXPECT_NEAR(climbing.strain.slip_angle_rad, 0, 1e-6);
  EXPECT_GT(climbing.strain.sinkage_m, 0.005);
  // The front wheels are lighter uphill.
  const double transfer = rover.on.weight_n() * std::sin(15 * kDegree) * 0.8 / (2 * 1.143) / 2;
  EXPECT_NEAR(climbing.strain.load_min_n,
              rover.on.weight_n() * std::cos(15 * kDegree) / 4 - transfer, 0.5);
}

TEST(VehicleDynamics, WheelsCarryMoreInDipsAndLessOnCrests) {
  const VehicleOnSoil on("lrv");
  for (const double curvature : {0.05, 0.0, -0.05}) {
    const VehicleDynamics dynamics(
        on.vehicle, on.soil_laws,
        [&](double, double, double) {
          GroundPatch patch = patch_with(0, 0);
          patch.curvature_1pm = curvature;
          return patch;
        },
        on.gravity_mps2);
    StepResult result{.state = dynamics.rolling_state(0, 0, 0, 3), .strain = {}};
    for (int i = 0; i < 30; ++i) result = dynamics.step(result.state, {3, 0}, 0.1);
    const double v = result.state.motion.vx_mps;
    const double load = on.vehicle.mass_kg * (on.gravity_mps2 + v * v * curvature) / 4;
    EXPECT_NEAR(result.strain.load_min_n, load, 0.01 * load) << curvature;
  }
}

TEST(VehicleDynamics, WeakMotorsClimbMoreSlowlyThanCommanded) {
  for (const double torque_nm : {1000.0, 25.0, 5.0}) {
    Vehicle vehicle = preset_vehicle("lrv");
    vehicle.torque_max_nm = torque_nm;
    const VehicleOnSoil on(vehicle, firm_regolith(), kMoon_mps2);
    const VehicleDynamics dynamics(on.vehicle, on.soil_laws, Plane{std::tan(8 * kDegree), 0},
                                   on.gravity_mps2);
    VehicleState state = dynamics.rolling_state(0, 0, 0, 1);
    StepResult next{.state = state, .strain = {}};
    for (int i = 0; i < 100; ++i) {
      next = dynamics.step(next.state, {1, 0}, 0.1);
      ASSERT_TRUE(next.converged) << torque_nm << ' ' << i;
    }
    EXPECT_LE(std::abs(next.strain.torque_max_nm), torque_nm + 1e-3);
    if (torque_nm == 1000) {
      EXPECT_GT(next.state.motion.vx_mps, 0.9);
    } else if (torque_nm == 5) {
      EXPECT_LT(next.state.motion.vx_mps, 0.2);
    }
  }
}

}  // namespace
}  // namespace regoplan
