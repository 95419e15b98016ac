#include "terramech/vehicle_dynamics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "terramech/force_table.h"
#include "terramech/trim.h"
#include "tests/terramech/lunar_soil.h"

namespace regoplan {
namespace {

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

double speed_of(const VehicleState& state) {
  return std::hypot(state.motion.vx_mps, state.motion.vy_mps);
}

double kinetic_energy_j(const Vehicle& vehicle, const VehicleState& state) {
  const BodyMotion& v = state.motion;
  return (vehicle.mass_kg * (v.vx_mps * v.vx_mps + v.vy_mps * v.vy_mps) +
          vehicle.yaw_inertia_kgm2 * v.yaw_rate_rad_s * v.yaw_rate_rad_s) /
         2;
}

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

/// Where an S at the given step ends: rim speed and steering ramp all the way, as smooth as
/// controls get. At 0.8 s the steering turns back.
VehicleState end_of_s(const Driving& rover, double speed_mps, double step_s) {
  const double rate = rover.on.vehicle.curvature_rate_max_1pms;
  VehicleState state = rover.dynamics.rolling_state(0, 0, 0, speed_mps);
  const double faster = 2 * rover.on.vehicle.speed_max_mps;
  state = rover.drive(state, {faster, 10 * rate}, 0.8, step_s).state;
  return rover.drive(state, {faster, -10 * rate}, 1.6, step_s).state;
}

TEST(VehicleDynamics, IsOfSecondOrderInTheStep) {
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

TEST(VehicleDynamics, HoldsLongStepsAtCreepingSpeed) {
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

TEST(VehicleDynamics, BrakesToAStandstillAndStaysThere) {
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

void expect_mirrored(const VehicleState& left, const VehicleState& right, double tolerance) {
  EXPECT_NEAR(left.x_m, right.x_m, tolerance);
  EXPECT_NEAR(left.y_m, -right.y_m, tolerance);
  EXPECT_NEAR(left.yaw_rad, -right.yaw_rad, tolerance);
  EXPECT_NEAR(left.motion.vx_mps, right.motion.vx_mps, tolerance);
  EXPECT_NEAR(left.motion.vy_mps, -right.motion.vy_mps, tolerance);
  EXPECT_NEAR(left.motion.yaw_rate_rad_s, -right.motion.yaw_rate_rad_s, tolerance);
}

constexpr double kRounding = 1e-12;

TEST(VehicleDynamics, MirrorsWithItsControls) {
  for (const std::string& name : preset_vehicle_names()) {
    const double steep = 0.1;
    const Driving one(name, Plane{0.05, steep}), other(name, Plane{0.05, -steep});
    const double top = one.on.vehicle.speed_max_mps, lock = one.on.vehicle.curvature_max_1pm;
    const VehicleState start = one.dynamics.rolling_state(0, 0, 0, 0.4 * top);
    const VehicleState left = one.drive(start, {0.5 * top, 0.4 * lock}, 5, 0.1).state;
    const VehicleState right = other.drive(start, {0.5 * top, -0.4 * lock}, 5, 0.1).state;
    expect_mirrored(left, right, kRounding);
    EXPECT_GT(left.yaw_rad, 1e-3) << name;
  }
}

TEST(VehicleDynamics, MirrorsThroughATableToo) {
  const VehicleOnSoil on("lrv");
  const ForceTable table({.model = on.model.spec(),
                          .nominal_load_n = on.weight_n() / 4,
                          .accuracy = {.at_999_permille = 5e-3, .at_worst = 2e-2}});
  const std::vector<WheelLaw> laws{WheelLaw(table)};
  const VehicleDynamics dynamics(on.vehicle, laws, Plane{}, on.gravity_mps2);
  const auto drive = [&](double side) {
    VehicleState state = dynamics.rolling_state(0, 0, 0, 3);
    for (int i = 0; i < 100; ++i) {
      const double bend = i % 40 < 20 ? 0.1 : -0.05;
      state = dynamics.step(state, {3.0 - 0.02 * i, side * bend}, 0.1).state;
    }
    return state;
  };
  expect_mirrored(drive(1), drive(-1), kRounding);
}

TEST(VehicleDynamics, AVehicleThatIsItsOwnMirrorImageReversesAsItDrives) {
  const Driving rover("lrv");
  const VehicleState ahead =
      rover.drive(rover.dynamics.rolling_state(0, 0, 0, 1), {2, 0.2}, 5, 0.1).state;
  const VehicleState back =
      rover.drive(rover.dynamics.rolling_state(0, 0, 0, -1), {-2, 0.2}, 5, 0.1).state;
  // Seen by someone who looks backwards: the curvature of the path keeps its side of the vehicle.
  EXPECT_NEAR(ahead.x_m, -back.x_m, 1e-9);
  EXPECT_NEAR(ahead.y_m, back.y_m, 1e-9);
  EXPECT_NEAR(ahead.yaw_rad, -back.yaw_rad, 1e-9);
}

TEST(VehicleDynamics, DoesNotDependOnWhichWayTheMapLies) {
  const Driving one("lrv", Plane{0.1, 0.2}), other("lrv", Plane{-0.2, 0.1});
  const VehicleState east =
      one.drive(one.dynamics.rolling_state(0, 0, 0, 1), {1, 0.2}, 5, 0.1).state;
  const VehicleState north =
      other.drive(other.dynamics.rolling_state(0, 0, 90 * kDegree, 1), {1, 0.2}, 5, 0.1).state;
  EXPECT_NEAR(north.x_m, -east.y_m, 1e-6);
  EXPECT_NEAR(north.y_m, east.x_m, 1e-6);
}

TEST(VehicleDynamics, LockedWheelsNeverGainEnergyOnTheFlat) {
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

TEST(VehicleDynamics, LockedWheelsHoldOnAGentleSlope) {
  const double gentle = std::tan(8 * kDegree);
  for (const Plane& plane : {Plane{gentle, 0}, Plane{-gentle, 0}, Plane{0, gentle}}) {
    const Driving rover("lrv", plane);
    const VehicleState start = rover.dynamics.rolling_state(0, 0, 0, 0);
    const VehicleState later = rover.drive(start, {0, 0}, 60, 0.5).state;
    EXPECT_LT(speed_of(later), 1e-3);
    EXPECT_LT(std::hypot(later.x_m, later.y_m), 0.06);
  }
}

TEST(VehicleDynamics, LockedWheelsSlideWhereTheSlopeIsBeyondFriction) {
  const Driving rover("lrv", Plane{std::tan(42 * kDegree), 0});
  const VehicleState later =
      rover.drive(rover.dynamics.rolling_state(0, 0, 0, 0), {0, 0}, 5, 0.1).state;
  EXPECT_LT(later.motion.vx_mps, -0.3);
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

TEST(VehicleDynamics, DrivingTakesTheEnergyThatItGainsAndTheSoilTakes) {
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

TEST(VehicleDynamics, ACrabbingVehicleMovesAsideWithoutTurning) {
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

TEST(VehicleDynamics, ASkidSteeredVehicleTurnsLessThanItsRimsCommand) {
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

TEST(VehicleDynamics, TurnsOnTheSpot) {
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
TEST(VehicleDynamics, ASymmetricVehicleTurnsOnTheSpotWithoutDrifting) {
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

TEST(VehicleDynamics, EveryDriveLawDrivesAndMirrors) {
  for (const auto change : {+[](Vehicle& v) { v.drive_law = DriveLaw::kEqualSpeed; },
                            +[](Vehicle& v) { v.drive_law = DriveLaw::kEqualTorque; },
                            +[](Vehicle& v) { v.wheels[2].driven = v.wheels[3].driven = false; }}) {
    Vehicle vehicle = preset_vehicle("lrv");
    change(vehicle);
    const VehicleOnSoil on(vehicle, firm_regolith(), kMoon_mps2);
    const VehicleDynamics dynamics(on.vehicle, on.soil_laws, Plane{}, on.gravity_mps2);
    const auto drive = [&](double curvature) {
      VehicleState state = dynamics.rolling_state(0, 0, 0, 0);
      for (int i = 0; i < 100; ++i) {
        const StepResult next = dynamics.step(state, {1.5, curvature}, 0.1);
        EXPECT_TRUE(next.converged) << i;
        state = next.state;
      }
      return state;
    };
    const VehicleState left = drive(0.1), right = drive(-0.1);
    EXPECT_GT(left.x_m, 5);
    EXPECT_GT(left.y_m, 1);
    expect_mirrored(left, right, kRounding);
  }
}

TEST(VehicleDynamics, ASlalomOfAMinuteNeedsNoFinerSteps) {
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
