#include "terramech/vehicle/steered_wheel.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/terramech/lunar_soil.h"

namespace regoplan {
namespace {

/// The rotation about the turn centre at 1 m/s of the origin.
BodyMotion slip_free(const Vehicle& vehicle, double curvature_1pm, double speed_mps = 1) {
  const double beta = kinematic_body_slip_angle_rad(vehicle, curvature_1pm);
  return {.vx_mps = speed_mps * std::cos(beta),
          .vy_mps = speed_mps * std::sin(beta),
          .yaw_rate_rad_s = speed_mps * curvature_1pm};
}

TEST(SteeredWheel, SlipFreeRotationHasNeitherSlipNorSlipAngle) {
  for (const std::string& name : preset_vehicle_names()) {
    const Vehicle vehicle = preset_vehicle(name);
    for (const double share : {-1.0, -0.3, 0.0, 0.7}) {
      for (const double speed : {2.0, -2.0}) {
        const double k = share * vehicle.curvature_max_1pm;
        for (const WheelMount& mount : vehicle.wheels) {
          const SteeredWheel wheel = steered_wheel(vehicle, mount, {k});
          const WheelMotion motion = wheel_motion(mount, wheel, slip_free(vehicle, k, speed),
                                                  speed * wheel.rim_speed_per_speed);
          const bool rolls_true = mount.steered || mount.x_m == vehicle.turn_centre_x_m;
          if (rolls_true) {
            EXPECT_NEAR(slip_angle_rad(motion), 0, 1e-12) << name << mount.name;
          }
          EXPECT_NEAR(slip_ratio(motion), 0, 1e-12) << name << mount.name;
        }
      }
    }
  }
}

TEST(SteeredWheel, TheOuterRimsTurnFasterByTheirRadius) {
  const Vehicle lrv = preset_vehicle("lrv");
  const double k = 0.2;
  for (const WheelMount& mount : lrv.wheels) {
    EXPECT_NEAR(steered_wheel(lrv, mount, {k}).rim_speed_per_speed,
                std::hypot(mount.x_m, 1 / k - mount.y_m) * k, 1e-12);
  }
}

TEST(WheelMotion, IsThatOfTheRigidBodyTurnedIntoTheWheelsHeading) {
  const WheelMount mount{.name = "corner", .x_m = 1.5, .y_m = 0.5};
  const SteeredWheel quarter_left{.cos_steer = 0, .sin_steer = 1};
  const WheelMotion motion = wheel_motion(mount, quarter_left, {2, 3, 4}, 7);
  // At the contact the body moves (2 - 4 * 0.5, 3 + 4 * 1.5) = (0, 9): along the heading, left.
  EXPECT_NEAR(motion.vx_mps, 9, 1e-15);
  EXPECT_NEAR(motion.vy_mps, 0, 1e-15);
  EXPECT_EQ(motion.rim_speed_mps, 7);
}

TEST(BodyForce, APositiveSideForcePushesToTheRightOfTheWheelsHeading) {
  const WheelMount mount{.name = "front", .x_m = 2, .y_m = 0};
  BodyForce sum;
  sum.add(mount, {}, {.fx_n = 10, .fy_n = 3});
  EXPECT_EQ(sum.forward_n, 10);
  EXPECT_EQ(sum.left_n, -3);
  EXPECT_EQ(sum.yaw_nm, -6);
}

TEST(BodyForce, AWheelOnTheLeftThatPullsTurnsToTheRight) {
  BodyForce sum;
  sum.add({.name = "left", .x_m = 0, .y_m = 1}, {}, {.fx_n = 10});
  EXPECT_EQ(sum.yaw_nm, -10);
}

TEST(BodyForce, PowerOnTheBodyIsThatOfTheWheels) {
  // The virtual work of turning motions one way and forces the other.
  const Vehicle lrv = preset_vehicle("lrv");
  const BodyMotion body{.vx_mps = 1.3, .vy_mps = -0.4, .yaw_rate_rad_s = 0.7};
  BodyForce sum;
  double power_w = 0;
  for (std::size_t i = 0; i < lrv.wheels.size(); ++i) {
    const SteeredWheel wheel = steered_wheel(lrv, lrv.wheels[i], {0.4});
    const WheelForces forces{.fx_n = 3.0 + double(i), .fy_n = 5.0 - 2.0 * double(i)};
    const WheelMotion motion = wheel_motion(lrv.wheels[i], wheel, body, 0);
    power_w += forces.fx_n * motion.vx_mps - forces.fy_n * motion.vy_mps;
    sum.add(lrv.wheels[i], wheel, forces);
  }
  EXPECT_NEAR(
      sum.forward_n * body.vx_mps + sum.left_n * body.vy_mps + sum.yaw_nm * body.yaw_rate_rad_s,
      power_w, 1e-12);
}

TEST(SteeredWheel, AllAreParallelWhenTheVehicleCrabs) {
  const Vehicle rover = preset_vehicle("tohoku");
  for (const WheelMount& mount : rover.wheels) {
    const SteeredWheel wheel = steered_wheel(rover, mount, {.crab_rad = 0.4});
    EXPECT_NEAR(wheel.steer_rad(), 0.4, 1e-15);
    EXPECT_NEAR(wheel.rim_speed_per_speed, 1, 1e-15);
  }
}

TEST(SteeredWheel, CrabAndCurvatureTogetherAreARotationAboutOnePoint) {
  const Vehicle rover = preset_vehicle("tohoku");
  const double k = 0.5, crab = 0.2;
  for (const WheelMount& mount : rover.wheels) {
    const SteeredWheel wheel = steered_wheel(rover, mount, {.curvature_1pm = k, .crab_rad = crab});
    const BodyMotion body{std::cos(crab), std::sin(crab), k};
    const WheelMotion motion = wheel_motion(mount, wheel, body, wheel.rim_speed_per_speed);
    EXPECT_NEAR(motion.vy_mps, 0, 1e-15);
    EXPECT_NEAR(motion.vx_mps, wheel.rim_speed_per_speed, 1e-15);
  }
}

TEST(WheelOnTheSpot, RollsAboutTheTurnCentre) {
  const Vehicle rover = preset_vehicle("tohoku");
  for (const WheelMount& mount : rover.wheels) {
    const SteeredWheel wheel = wheel_on_the_spot(rover, mount);
    const WheelMotion motion = wheel_motion(mount, wheel, {.yaw_rate_rad_s = 1}, 0);
    EXPECT_NEAR(motion.vy_mps, 0, 1e-15);
    EXPECT_NEAR(motion.vx_mps, wheel.rim_speed_per_speed, 1e-15);
    EXPECT_LE(std::abs(wheel.steer_rad()), 90 * kDegree);
    EXPECT_EQ(wheel.rim_speed_per_speed<0, mount.y_m> 0);
  }
}

TEST(CanTurnOnTheSpot, TakesWheelsThatReachTheAngle) {
  EXPECT_TRUE(can_turn_on_the_spot(preset_vehicle("curiosity")));
  EXPECT_FALSE(can_turn_on_the_spot(preset_vehicle("lrv")));
  EXPECT_FALSE(can_turn_on_the_spot(tricycle()));
  EXPECT_TRUE(can_turn_on_the_spot(skid_steered()));
}

}  // namespace
}  // namespace regoplan
