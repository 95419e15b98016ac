#include "terramech/margins/trim.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "terramech/force_table/force_table.h"
#include "terramech/vehicle/vehicle_dynamics.h"
#include "tests/terramech/lunar_soil.h"

namespace regoplan {
namespace {

constexpr double kRounding = 1e-12;

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
    EXPECT_NEAR(trim.steer_curvature_1pm, 0, kRounding) << name;
    EXPECT_NEAR(trim.body_slip_angle_rad, 0, kRounding) << name;
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
    EXPECT_NEAR(one.body_slip_angle_rad, -other.body_slip_angle_rad, kRounding) << name;
    EXPECT_NEAR(one.steer_curvature_1pm, -other.steer_curvature_1pm, kRounding) << name;
    EXPECT_NEAR(one.drive_factor, other.drive_factor, kRounding) << name;
    const double close = kRounding * on.weight_n();
    for (std::size_t i = 0; i < one.wheels.size(); i += 2) {  // wheels come in pairs
      EXPECT_NEAR(one.wheels[i].load_n, other.wheels[i + 1].load_n, close) << name;
      EXPECT_NEAR(one.wheels[i].forces.fx_n, other.wheels[i + 1].forces.fx_n, close) << name;
      EXPECT_NEAR(one.wheels[i].forces.fy_n, -other.wheels[i + 1].forces.fy_n, close) << name;
    }
  }
}

TEST(Trim, AVehicleThatIsItsOwnMirrorImageFrontToRearReversesAsItDrives) {
  const VehicleOnSoil on("lrv");
  const double k = 0.3, forward_n = 0.15 * on.weight_n(), left_n = 0.2 * on.weight_n();
  const Trim ahead = trim_of(on.manoeuvre(k), forward_n, left_n);
  const Trim back = trim_of(on.manoeuvre(k, true), -forward_n, left_n);
  EXPECT_NEAR(ahead.drive_factor, back.drive_factor, 1e-6);
  EXPECT_NEAR(ahead.steer_curvature_1pm, back.steer_curvature_1pm, 1e-6);
  // The tail of the one is the nose of the other.
  EXPECT_NEAR(ahead.wheels[0].load_n, back.wheels[2].load_n, 1e-3 * on.weight_n());
}

TEST(Trim, IsNoneBeyondWhatTheSoilGives) {
  const VehicleOnSoil on("lrv");
  EXPECT_FALSE(on.manoeuvre(0).solve_from_rolling(at_force(0.9 * on.weight_n(), 0)));
  EXPECT_FALSE(on.manoeuvre(0).solve_from_rolling(at_force(-0.95 * on.weight_n(), 0)));
}

/// A table that is quick to build.
ForceTable rough_table(const VehicleOnSoil& on) {
  return ForceTable({.model = on.model.spec(),
                     .nominal_load_n = on.weight_n() / 4,
                     .accuracy = {.at_999_permille = 5e-3, .at_worst = 2e-2}});
}

void expect_slopes_of_the_balance(const SteadyManoeuvre& manoeuvre,
                                  const SteadyManoeuvre::Point& at, const ForceLine& line,
                                  double allowed) {
  const auto slopes = manoeuvre.slopes(at, line);
  ASSERT_TRUE(slopes);
  constexpr double kStep = 1e-4;
  for (int k = 0; k < 4; ++k) {
    SteadyManoeuvre::Point up = at, down = at;
    up[k] += kStep;
    down[k] -= kStep;
    const SteadyManoeuvre::Residual slope =
        (*manoeuvre.residual(up, line) - *manoeuvre.residual(down, line)) / (2 * kStep);
    EXPECT_LT((slopes->col(k) - slope).norm(), allowed * slope.norm()) << k;
  }
}

TEST(Trim, SlopesOfATabledLawAreThoseOfTheBalance) {
  const VehicleOnSoil on("lrv");
  const ForceTable table = rough_table(on);
  const std::vector<WheelLaw> laws(4, WheelLaw(table));
  const SteadyManoeuvre manoeuvre(on.vehicle, on.sharing, laws, 0.2, on.weight_n());
  const ForceLine line{.from = {.forward_n = 0.1 * on.weight_n(), .left_n = 0},
                       .per_unit = {.forward_n = 0, .left_n = on.weight_n()}};
  expect_slopes_of_the_balance(manoeuvre, {-0.3, 0.3, 0.4, 0.2}, line, 2e-3);
}

TEST(Trim, HoldsTheDriveLaw) {
  for (const DriveLaw law : {DriveLaw::kEqualSpeed, DriveLaw::kEqualTorque}) {
    for (const bool all_driven : {true, false}) {
      Vehicle vehicle = preset_vehicle("lrv");
      vehicle.drive_law = law;
      vehicle.wheels[2].driven = vehicle.wheels[3].driven = all_driven;
      const VehicleOnSoil on(vehicle, firm_regolith(), kMoon_mps2);
      const Trim trim = trim_of(on.manoeuvre(0.15), 0.05 * on.weight_n(), 0.1 * on.weight_n());
      for (std::size_t i = 0; i < 4; ++i) {
        const double torque = trim.wheels[i].forces.torque_nm;
        if (!vehicle.wheels[i].driven) {
          EXPECT_NEAR(torque, 0, 1e-4);
        } else if (law == DriveLaw::kEqualTorque) {
          EXPECT_NEAR(torque, trim.wheels[0].forces.torque_nm, 1e-4);
        }
      }
      if (law == DriveLaw::kEqualSpeed) {
        // One rim speed on two radii: the inner wheels, on the left, slip more.
        EXPECT_GT(trim.wheels[0].slip, trim.wheels[1].slip + 0.1);
      }
    }
  }
}

TEST(Trim, SkidSteeringTurnsTheOuterRimsFasterThanTheTurnItself) {
  const VehicleOnSoil on(skid_steered(), firm_regolith(), kMoon_mps2);
  const double k = 0.05;
  const Trim trim = trim_of(on.manoeuvre(k), 0);
  EXPECT_GT(trim.steer_curvature_1pm, 1.2 * k);
  EXPECT_LT(trim.wheels[0].slip, trim.wheels[1].slip);
}

TEST(Trim, CrabSteeringMovesAlongItsWheels) {
  Vehicle vehicle = preset_vehicle("tohoku");
  vehicle.steering = Steering::kCrab;
  const VehicleOnSoil on(vehicle, firm_regolith(), kEarth_mps2);
  const Trim trim = trim_of(on.manoeuvre(0, false, 0.3), 0);
  EXPECT_NEAR(trim.body_slip_angle_rad, 0.3, 1e-5);
  for (const TrimmedWheel& wheel : trim.wheels) {
    EXPECT_NEAR(wheel.steer_rad, 0.3, 1e-5);
    EXPECT_NEAR(wheel.slip_angle_rad, 0, 1e-5);
  }
}

Trim turn_trim(const SteadyManoeuvre& turn, const PathForce& force = {}) {
  const ForceLine line{.from = force, .per_unit = {}};
  const auto at = turn.solve_from_rolling(line);
  EXPECT_TRUE(at);
  return at ? turn.trim(*at, line) : Trim{};
}

TEST(PointTrim, BalancesForcesAndYawMomentByHand) {
  for (const Vehicle& vehicle : {preset_vehicle("curiosity"), skid_steered()}) {
    const VehicleOnSoil on(vehicle, firm_regolith(), kMoon_mps2);
    const double weight = on.weight_n();
    const PathForce force{.forward_n = 0.08 * weight, .left_n = -0.05 * weight};
    for (const bool left : {true, false}) {
      const Trim trim = turn_trim(
          SteadyManoeuvre::turn_on_the_spot(on.vehicle, on.sharing, on.wheel_laws, weight, left),
          force);
      ASSERT_EQ(trim.wheels.size(), on.vehicle.wheels.size());
      BodyForce sum;
      for (std::size_t i = 0; i < trim.wheels.size(); ++i) {
        const TrimmedWheel& wheel = trim.wheels[i];
        sum.add(on.vehicle.wheels[i],
                {.cos_steer = std::cos(wheel.steer_rad), .sin_steer = std::sin(wheel.steer_rad)},
                wheel.forces);
        // Rims of the side that is behind turn backwards.
        EXPECT_EQ(wheel.motion.rim_speed_mps > 0, (on.vehicle.wheels[i].y_m < 0) == left);
      }
      EXPECT_NEAR(sum.forward_n, force.forward_n, 1e-4 * weight) << vehicle.name;
      EXPECT_NEAR(sum.left_n, force.left_n, 1e-4 * weight) << vehicle.name;
      EXPECT_NEAR(sum.yaw_nm, 0, 1e-4 * weight) << vehicle.name;
    }
  }
}

TEST(PointTrim, ScrubTakesDriveWhereWheelsDoNotSteer) {
  const VehicleOnSoil steered("curiosity"), dragged(skid_steered(), firm_regolith(), kMoon_mps2);
  const auto factor = [](const VehicleOnSoil& on) {
    return turn_trim(SteadyManoeuvre::turn_on_the_spot(on.vehicle, on.sharing, on.wheel_laws,
                                                       on.weight_n(), true))
        .drive_factor;
  };
  const double straight_on = trim_of(steered.manoeuvre(0), 0).drive_factor;
  EXPECT_NEAR(factor(steered), straight_on, 0.01);
  EXPECT_GT(factor(dragged), 1.15);
}

TEST(PointTrim, IsThatOfTheDynamics) {
  for (const Vehicle& vehicle : {preset_vehicle("curiosity"), skid_steered()}) {
    const VehicleOnSoil on(vehicle, firm_regolith(), kMoon_mps2);
    const VehicleDynamics dynamics(on.vehicle, on.soil_laws, Plane{}, on.gravity_mps2);
    const double rate = 0.5 * on.vehicle.speed_max_mps / longest_arm_m(on.vehicle);
    VehicleState state = dynamics.rolling_state(0, 0, 0, 0);
    for (int i = 0; i < 300; ++i) {
      state = dynamics.step(state, {.turn_rate_target_rad_s = rate}, 0.1).state;
    }
    const Trim trim = turn_trim(SteadyManoeuvre::turn_on_the_spot(
        on.vehicle, on.sharing, on.wheel_laws, on.weight_n(), true));
    EXPECT_NEAR(rate / state.motion.yaw_rate_rad_s, trim.drive_factor, 2e-2 * trim.drive_factor)
        << vehicle.name;
  }
}

TEST(PointTrim, SlopesOfATabledLawAreThoseOfTheBalance) {
  const VehicleOnSoil on(skid_steered(), firm_regolith(), kMoon_mps2);
  const ForceTable table = rough_table(on);
  const std::vector<WheelLaw> laws(4, WheelLaw(table));
  const auto turn =
      SteadyManoeuvre::turn_on_the_spot(on.vehicle, on.sharing, laws, on.weight_n(), false);
  const ForceLine line{.from = {.forward_n = 0.1 * on.weight_n()},
                       .per_unit = {.left_n = on.weight_n(), .yaw_nm = 0.5 * on.weight_n()}};
  expect_slopes_of_the_balance(turn, {0.1, -0.2, 1.2, 0.05}, line, 5e-3);
}

/// The linear bicycle model in a steady turn at speed v: lateral and yaw balance of two axles whose
/// stiffnesses are the wheel model's own dFy/dbeta at the trimmed loads and slips. The wheels'
/// pull is turned with their heading, as it is in the trim. A trim near zero lateral force has
/// small slip angles of both signs only if its pull is small: here the flat, straight and slow.
TEST(Trim, IsTheLinearBicycleModelAtSmallAngles) {
  for (const std::string& name : preset_vehicle_names()) {
    const VehicleOnSoil on(name);
    const SteadyManoeuvre manoeuvre = on.manoeuvre(0);
    const double left_n = 2e-3 * on.weight_n();
    const Trim trim = trim_of(manoeuvre, 0, left_n);
    // Side force -C beta with beta = body slip + kappa x - steer; kappa = 0.
    double stiffness = 0;
    for (const TrimmedWheel& wheel : trim.wheels) {
      constexpr double kStep_rad = 1e-4;
      const auto fy = [&](double beta) {
        return on.model.forces(wheel.load_n, motion_at(wheel.slip, beta)).fy_n;
      };
      stiffness += (fy(kStep_rad) - fy(-kStep_rad)) / (2 * kStep_rad);
    }
    double mean_slip_angle = 0;
    for (const TrimmedWheel& wheel : trim.wheels) {
      mean_slip_angle += wheel.slip_angle_rad / static_cast<double>(trim.wheels.size());
    }
    EXPECT_NEAR(-stiffness * mean_slip_angle, left_n, 0.02 * left_n) << name;
  }
}

/// Slip angle of each wheel in the linear bicycle model of a turn: small angles, every wheel's side
/// force its stiffness times its slip angle b + k x - s (x - x_c), s where it steers. Body slip b
/// and steering s balance the lateral force and the yaw moment,
/// with what the wheels' pull turns: loaded unevenly by the turn, one side pulls more.
std::vector<double> bicycle_slip_angles(const Vehicle& vehicle,
                                        const std::vector<double>& stiffness, double k,
                                        double left_n, double pull_yaw_nm) {
  double force_b = 0, force_s = 0, force_0 = 0;
  double moment_b = 0, moment_s = 0, moment_0 = -pull_yaw_nm;
  const auto steers = [&](const WheelMount& wheel) {
    return wheel.steered ? wheel.x_m - vehicle.turn_centre_x_m : 0;
  };
  for (std::size_t i = 0; i < vehicle.wheels.size(); ++i) {
    const double c = stiffness[i], x = vehicle.wheels[i].x_m, to_s = -steers(vehicle.wheels[i]);
    force_b += c;
    force_s += c * to_s;
    force_0 += c * k * x;
    moment_b += c * x;
    moment_s += c * x * to_s;
    moment_0 += c * k * x * x;
  }
  const double right = -left_n - force_0, det = force_b * moment_s - force_s * moment_b;
  const double b = (right * moment_s + force_s * moment_0) / det;
  const double s = (-force_b * moment_0 - moment_b * right) / det;
  std::vector<double> angles;
  for (const WheelMount& wheel : vehicle.wheels) {
    angles.push_back(b + k * wheel.x_m - s * steers(wheel));
  }
  return angles;
}

TEST(Trim, IsTheLinearBicycleModelInGentleTurns) {
  std::vector<Vehicle> vehicles;
  for (const std::string& name : preset_vehicle_names()) vehicles.push_back(preset_vehicle(name));
  // Weight on the nose and on the tail: under- and oversteer.
  for (const double shift_m : {-0.3, 0.3}) {
    vehicles.push_back(preset_vehicle("lrv"));
    for (WheelMount& wheel : vehicles.back().wheels) wheel.x_m += shift_m;
    vehicles.back().turn_centre_x_m = shift_m;
    vehicles.back().cg_height_m = 0.3;
  }
  for (const Vehicle& vehicle : vehicles) {
    const VehicleOnSoil on(vehicle, firm_regolith(), home_gravity_mps2(vehicle.name));
    for (const double k : {2e-3, -2e-3}) {
      const double left_n = std::copysign(4e-3, k) * on.weight_n();
      const Trim trim = trim_of(on.manoeuvre(k), 0, left_n);
      std::vector<double> stiffness;
      double pull_yaw_nm = 0;
      for (std::size_t i = 0; i < trim.wheels.size(); ++i) {
        pull_yaw_nm -= vehicle.wheels[i].y_m * trim.wheels[i].forces.fx_n;
      }
      for (const TrimmedWheel& wheel : trim.wheels) {
        constexpr double kStep_rad = 1e-4;
        const auto fy = [&](double beta) {
          return on.model.forces(wheel.load_n, motion_at(wheel.slip, beta)).fy_n;
        };
        stiffness.push_back((fy(kStep_rad) - fy(-kStep_rad)) / (2 * kStep_rad));
      }
      const std::vector<double> angles =
          bicycle_slip_angles(vehicle, stiffness, k, left_n, pull_yaw_nm);
      double largest = 0;
      for (const double angle : angles) largest = std::max(largest, std::abs(angle));
      for (std::size_t i = 0; i < angles.size(); ++i) {
        EXPECT_NEAR(trim.wheels[i].slip_angle_rad, angles[i], 0.02 * largest)
            << vehicle.name << ' ' << vehicle.wheels[i].name << ' ' << k;
      }
    }
  }
}

TEST(Trim, MirrorsExactly) {
  const VehicleOnSoil on("lrv");
  const double k = 0.2, left_n = 0.2 * on.weight_n();
  const SteadyManoeuvre one = on.manoeuvre(k), other = on.manoeuvre(-k);
  const SteadyManoeuvre::Point at{-0.3, 0.7, 0.2, 0.5}, mirrored{0.3, -0.7, 0.2, 0.5};
  const auto missing = one.residual(at, at_force(50, left_n));
  const auto missing_mirrored = other.residual(mirrored, at_force(50, -left_n));
  EXPECT_NEAR((*missing)[0], (*missing_mirrored)[0], 1e-12);
  EXPECT_NEAR((*missing)[1], -(*missing_mirrored)[1], 1e-12);
  EXPECT_NEAR((*missing)[2], -(*missing_mirrored)[2], 1e-12);
}

}  // namespace
}  // namespace regoplan
