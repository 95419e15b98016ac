#include "terramech/trim.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/terramech/lunar_soil.h"

namespace regoplan {
namespace {

ForceLine at_force(double forward_n, double left_n) {
  return {.from = {.forward_n = forward_n, .left_n = left_n}, .per_unit = {}};
}

/// The trim with these path forces, from rolling; the test fails where there is none.
Trim trim_of(const SteadyManoeuvre& manoeuvre, double forward_n, double left_n = 0) {
  const auto rolling = manoeuvre.solve_from_rolling(at_force(forward_n, 0));
  EXPECT_TRUE(rolling);
  if (!rolling) return {};
  const auto there = manoeuvre.solve(*rolling, at_force(forward_n, left_n));
  EXPECT_TRUE(there);
  if (!there) return {};
  return manoeuvre.trim(*there, at_force(forward_n, left_n));
}

TEST(Trim, BalancesForcesAndYawMomentByHand) {
  for (const std::string& name : preset_vehicle_names()) {
    const VehicleOnSoil on(name);
    const double weight = on.weight_n();
    for (const double share : {-1.0, -0.4, 0.0, 0.6}) {
      for (const bool reverse : {false, true}) {
        const double k = share * on.vehicle.curvature_max_1pm;
        const double forward_n = (reverse ? -0.1 : 0.1) * weight, left_n = 0.15 * weight;
        const Trim trim = trim_of(on.manoeuvre(k, reverse), forward_n, left_n);
        ASSERT_EQ(trim.wheels.size(), on.vehicle.wheels.size());
        double forward = 0, left = 0, yaw = 0, normal = 0;
        for (std::size_t i = 0; i < trim.wheels.size(); ++i) {
          const TrimmedWheel& wheel = trim.wheels[i];
          const WheelMount& mount = on.vehicle.wheels[i];
          const double c = std::cos(wheel.steer_rad), s = std::sin(wheel.steer_rad);
          const double along = c * wheel.forces.fx_n + s * wheel.forces.fy_n;
          const double across = s * wheel.forces.fx_n - c * wheel.forces.fy_n;
          forward += along;
          left += across;
          yaw += mount.x_m * across - mount.y_m * along;
          normal += wheel.load_n;
        }
        const double c = std::cos(trim.body_slip_angle_rad), s = std::sin(trim.body_slip_angle_rad);
        EXPECT_NEAR(c * forward + s * left, forward_n, 1e-4 * weight) << name << k;
        EXPECT_NEAR(c * left - s * forward, left_n, 1e-4 * weight) << name << k;
        EXPECT_NEAR(yaw, 0, 1e-4 * weight) << name << k;
        EXPECT_NEAR(normal, weight, 1e-9 * weight) << name << k;
      }
    }
  }
}

TEST(Trim, SlipAnglesAreThoseOfTheRigidBodyAboutThePathsCentre) {
  const VehicleOnSoil on("lrv");
  const double k = 0.2;
  const Trim trim = trim_of(on.manoeuvre(k), 0, 0.2 * on.weight_n());
  const double beta = trim.body_slip_angle_rad;
  for (std::size_t i = 0; i < trim.wheels.size(); ++i) {
    const WheelMount& mount = on.vehicle.wheels[i];
    const double direction =
        std::atan2(std::sin(beta) + k * mount.x_m, std::cos(beta) - k * mount.y_m);
    EXPECT_NEAR(trim.wheels[i].slip_angle_rad, direction - trim.wheels[i].steer_rad, 1e-9);
  }
}

TEST(Trim, StraightOnTheFlatNeedsNoSteeringAndALittleDriveAgainstTheSoil) {
  for (const std::string& name : preset_vehicle_names()) {
    const Trim trim = trim_of(VehicleOnSoil(name).manoeuvre(0), 0);
    EXPECT_NEAR(trim.steer_curvature_1pm, 0, 1e-6) << name;
    EXPECT_NEAR(trim.body_slip_angle_rad, 0, 1e-6) << name;
    for (const TrimmedWheel& wheel : trim.wheels) EXPECT_GT(wheel.forces.torque_nm, 0) << name;
  }
}

TEST(Trim, MoreForwardForceTakesMoreDrive) {
  const VehicleOnSoil on("lrv");
  double before = 0;
  for (const double share : {-0.3, -0.1, 0.0, 0.1, 0.3, 0.45}) {
    const double factor = trim_of(on.manoeuvre(0.1), share * on.weight_n()).drive_factor;
    EXPECT_GT(factor, before) << share;
    before = factor;
  }
}

TEST(Trim, AForceToTheLeftComesFromMovingToTheRightOfTheWheels) {
  const VehicleOnSoil on("lrv");
  const Trim trim = trim_of(on.manoeuvre(0), 0, 0.3 * on.weight_n());
  for (const TrimmedWheel& wheel : trim.wheels) EXPECT_LT(wheel.slip_angle_rad, 0);
}

TEST(Trim, MirrorsWithTheManoeuvre) {
  for (const std::string& name : preset_vehicle_names()) {
    const VehicleOnSoil on(name);
    const double k = 0.7 * on.vehicle.curvature_max_1pm;
    const double forward_n = 0.1 * on.weight_n(), left_n = 0.2 * on.weight_n();
    const Trim one = trim_of(on.manoeuvre(k), forward_n, left_n);
    const Trim other = trim_of(on.manoeuvre(-k), forward_n, -left_n);
    EXPECT_NEAR(one.body_slip_angle_rad, -other.body_slip_angle_rad, 1e-4) << name;
    EXPECT_NEAR(one.steer_curvature_1pm, -other.steer_curvature_1pm, 2e-4) << name;
    EXPECT_NEAR(one.drive_factor, other.drive_factor, 1e-4) << name;
    for (std::size_t i = 0; i < one.wheels.size(); i += 2) {  // wheels come in pairs
      EXPECT_NEAR(one.wheels[i].load_n, other.wheels[i + 1].load_n, 1e-3 * on.weight_n()) << name;
    }
  }
}

TEST(Trim, AVehicleThatIsItsOwnMirrorImageFrontToRearReversesAsItDrives) {
  const VehicleOnSoil on("lrv");
  const double k = 0.3, forward_n = 0.15 * on.weight_n(), left_n = 0.2 * on.weight_n();
  const Trim ahead = trim_of(on.manoeuvre(k), forward_n, left_n);
  const Trim back = trim_of(on.manoeuvre(k, true), -forward_n, left_n);
  EXPECT_NEAR(ahead.drive_factor, back.drive_factor, 1e-4);
  EXPECT_NEAR(ahead.steer_curvature_1pm, back.steer_curvature_1pm, 2e-4);
  // The tail of the one is the nose of the other.
  EXPECT_NEAR(ahead.wheels[0].load_n, back.wheels[2].load_n, 1e-3 * on.weight_n());
}

TEST(Trim, IsNoneBeyondWhatTheSoilGives) {
  const VehicleOnSoil on("lrv");
  EXPECT_FALSE(on.manoeuvre(0).solve_from_rolling(at_force(0.9 * on.weight_n(), 0)));
  EXPECT_FALSE(on.manoeuvre(0).solve_from_rolling(at_force(-0.95 * on.weight_n(), 0)));
}

}  // namespace
}  // namespace regoplan
