#include <gtest/gtest.h>

#include <cmath>

#include "terramech/force_table/force_table.h"
#include "tests/terramech/driving.h"

namespace regoplan {
namespace {

TEST(VehicleSymmetry, MirrorsWithItsControls) {
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

TEST(VehicleSymmetry, MirrorsThroughATableToo) {
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

TEST(VehicleSymmetry, AVehicleThatIsItsOwnMirrorImageReversesAsItDrives) {
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

TEST(VehicleSymmetry, DoesNotDependOnWhichWayTheMapLies) {
  const Driving one("lrv", Plane{0.1, 0.2}), other("lrv", Plane{-0.2, 0.1});
  const VehicleState east =
      one.drive(one.dynamics.rolling_state(0, 0, 0, 1), {1, 0.2}, 5, 0.1).state;
  const VehicleState north =
      other.drive(other.dynamics.rolling_state(0, 0, 90 * kDegree, 1), {1, 0.2}, 5, 0.1).state;
  EXPECT_NEAR(north.x_m, -east.y_m, 1e-6);
  EXPECT_NEAR(north.y_m, east.x_m, 1e-6);
}

TEST(VehicleSymmetry, EveryDriveLawDrivesAndMirrors) {
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

}  // namespace
}  // namespace regoplan
