#include "terramech/vehicle/wheel_sums.h"

#include <gtest/gtest.h>

#include "terramech/force_table/force_table.h"
#include "tests/terramech/lunar_soil.h"

namespace regoplan {
namespace {

constexpr BodyMotion kMotion{.vx_mps = 2, .vy_mps = -0.2, .yaw_rate_rad_s = 0.15};
constexpr double kCurvature_1pm = 0.1, kRim_mps = 2.2;

Eigen::Vector3d vector_of(const BodyForce& force) {
  return {force.forward_n, force.left_n, force.yaw_nm};
}

struct Rolling {
  VehicleOnSoil on;
  VehicleWheels wheels{on.vehicle, on.soil_laws};
  GroundPatch patch = patch_with(0, 0);
  GroundReaction reaction{.normal_n = on.weight_n(), .forward_n = 50, .left_n = 100};

  explicit Rolling(const Vehicle& vehicle = preset_vehicle("lrv"))
      : on(vehicle, firm_regolith(), kMoon_mps2) {}
  WheelSetting setting(double curvature_1pm = kCurvature_1pm, double rim_mps = kRim_mps) const {
    return {.wheels = steered_wheels(on.vehicle, {curvature_1pm}), .rim_speed = rim_mps};
  }
  WheelSums sums(const BodyMotion& motion = kMotion) const {
    return wheels.sums(motion, setting(), patch, reaction);
  }
};

Vehicle lrv_with(void (*change)(Vehicle&)) {
  Vehicle vehicle = preset_vehicle("lrv");
  change(vehicle);
  return vehicle;
}

/// Slopes against differences of the sums themselves.
void expect_slopes(const VehicleWheels& wheels, const Rolling& rolling, double tolerance) {
  const auto force = [&](const BodyMotion& motion, const WheelSetting& setting) {
    return vector_of(wheels.sums(motion, setting, rolling.patch, rolling.reaction).force);
  };
  const WheelSetting setting = rolling.setting();
  const WheelSetting next = rolling.setting(kCurvature_1pm + 1e-4, kRim_mps + 1e-3);
  const SlopedWheelSums sloped =
      wheels.sums_with_slopes(kMotion, setting, next, rolling.patch, rolling.reaction);
  EXPECT_LT((vector_of(sloped.sums.force) - force(kMotion, setting)).norm(), 1e-3);
  constexpr double kStep = 1e-3;
  for (int k = 0; k < 3; ++k) {
    const auto moved = [&](double by) {
      BodyMotion motion = kMotion;
      (k == 0 ? motion.vx_mps : k == 1 ? motion.vy_mps : motion.yaw_rate_rad_s) += by;
      return motion;
    };
    const Eigen::Vector3d slope =
        (force(moved(kStep), setting) - force(moved(-kStep), setting)) / (2 * kStep);
    EXPECT_LT((sloped.slopes.col(k) - slope).norm(), tolerance * slope.norm()) << k;
  }
  if (!sloped.smooth) return;
  const Eigen::Vector3d change = force(kMotion, next) - force(kMotion, setting);
  EXPECT_LT((sloped.by_setting - change).norm(), 2 * tolerance * change.norm());
}

TEST(VehicleWheels, SlopesAreThoseOfTheForces) {
  const Rolling rolling;
  expect_slopes(rolling.wheels, rolling, 0.01);
  const ForceTable table({.model = rolling.on.model.spec(),
                          .nominal_load_n = rolling.on.weight_n() / 4,
                          .accuracy = {.at_999_permille = 5e-3, .at_worst = 2e-2}});
  const std::vector<WheelLaw> laws{WheelLaw(table)};
  expect_slopes(VehicleWheels(rolling.on.vehicle, laws), rolling, 0.01);
}

TEST(VehicleWheels, SlopesAreThoseOfTheForcesUnderEveryDriveLaw) {
  for (const auto change : {+[](Vehicle& v) { v.drive_law = DriveLaw::kEqualSpeed; },
                            +[](Vehicle& v) { v.drive_law = DriveLaw::kEqualTorque; },
                            +[](Vehicle& v) { v.wheels[2].driven = v.wheels[3].driven = false; },
                            +[](Vehicle& v) { v.torque_max_nm = 15; }}) {
    const Rolling rolling(lrv_with(change));
    expect_slopes(rolling.wheels, rolling, 0.01);
  }
}

TEST(VehicleWheels, WheelsThatAreNotDrivenRollFreely) {
  const Rolling rolling(
      lrv_with([](Vehicle& v) { v.wheels[2].driven = v.wheels[3].driven = false; }));
  const Rolling all;
  EXPECT_FALSE(rolling.sums().as_commanded);
  EXPECT_LT(rolling.sums().force.forward_n, all.sums().force.forward_n);
  // Alone, they only resist.
  Vehicle towed = preset_vehicle("lrv");
  for (WheelMount& wheel : towed.wheels) wheel.driven = false;
  const VehicleWheels free(towed, rolling.on.soil_laws);
  const WheelSums sums =
      free.sums({.vx_mps = 1}, rolling.setting(0), rolling.patch, rolling.reaction);
  EXPECT_LT(sums.force.forward_n, 0);
  EXPECT_NEAR(sums.contact.torque_max_nm, 0, 1e-4);
}

TEST(VehicleWheels, AMotorGivesNoMoreThanItsTorque) {
  const double unlimited = Rolling().sums().contact.torque_max_nm;
  ASSERT_GT(unlimited, 16);
  const Rolling weak(lrv_with([](Vehicle& v) { v.torque_max_nm = 15; }));
  EXPECT_NEAR(weak.sums().contact.torque_max_nm, 15, 1e-4);
  EXPECT_LT(weak.sums().force.forward_n, Rolling().sums().force.forward_n);
  const Rolling strong(lrv_with([](Vehicle& v) { v.torque_max_nm = 1000; }));
  EXPECT_EQ(strong.sums().force.forward_n, Rolling().sums().force.forward_n);
}

TEST(VehicleWheels, EqualTorqueAtEqualLoadsIsKinematicDriving) {
  const Rolling shared(lrv_with([](Vehicle& v) { v.drive_law = DriveLaw::kEqualTorque; }));
  const Rolling kinematic;
  const GroundReaction even{.normal_n = shared.on.weight_n()};
  const BodyMotion ahead{.vx_mps = 2};
  const WheelSums one = shared.wheels.sums(ahead, shared.setting(0), shared.patch, even);
  const WheelSums other = kinematic.wheels.sums(ahead, kinematic.setting(0), shared.patch, even);
  EXPECT_NEAR(one.force.forward_n, other.force.forward_n, 1e-3);
}

}  // namespace
}  // namespace regoplan
