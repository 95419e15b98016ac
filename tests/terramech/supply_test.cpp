#include "terramech/margins/supply.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "terramech/margins/margins.h"
#include "tests/terramech/lunar_soil.h"

namespace regoplan {
namespace {

TEST(CorneringSupply, OfAnLrvOnLunarSoilIsAboutHalfItsWeightAtTheTestedSlipAngle) {
  const VehicleOnSoil on("lrv");
  const SupplyResult result = on.supply(0.05, 0, true);
  ASSERT_TRUE(result.supply);
  const SupplyEnd& left = result.supply->left;
  EXPECT_NEAR(left.force_n / on.weight_n(), 0.53, 0.03);
  EXPECT_EQ(left.limit, BranchLimit::kSlipAngle);
  // The fold is reported and is no supply: it takes slip angles of 36 deg.
  ASSERT_TRUE(left.fold_n);
  EXPECT_GT(*left.fold_n, 1.2 * left.force_n);
}

TEST(CorneringSupply, RejectsTenMetresAtThreeMetresASecondAndAcceptsTwenty) {
  const VehicleOnSoil on("lrv");
  for (const double side : {-1.0, 1.0}) {
    const auto margin = [&](double radius_m) {
      const double k = side / radius_m;
      const SupplyResult result = on.supply(k);
      EXPECT_TRUE(result.supply);
      return cornering_margin(cornering_demand_n(on.vehicle.mass_kg, 3, k, 0),
                              result.supply->right.force_n, result.supply->left.force_n,
                              on.weight_n());
    };
    EXPECT_LT(margin(10), 0);
    EXPECT_GT(margin(20), 0.2);
  }
}

TEST(CorneringSupply, MirrorsWithTheTurn) {
  for (const std::string& name : preset_vehicle_names()) {
    const VehicleOnSoil on(name);
    for (const double share : {0.0, 0.2, 0.6, 1.0}) {
      for (const double forward : {-0.2, 0.0, 0.2}) {
        const double k = share * on.vehicle.curvature_max_1pm;
        const SupplyResult one = on.supply(k, forward * on.weight_n());
        const SupplyResult other = on.supply(-k, forward * on.weight_n());
        ASSERT_EQ(one.supply.has_value(), other.supply.has_value()) << name << k << forward;
        if (!one.supply) continue;  // an LRV that brakes at full lock
        const double close = 1e-12 * on.weight_n();
        EXPECT_NEAR(one.supply->left.force_n, -other.supply->right.force_n, close) << name << k;
        EXPECT_NEAR(one.supply->right.force_n, -other.supply->left.force_n, close) << name << k;
        EXPECT_EQ(one.supply->left.limit, other.supply->right.limit) << name << k;
      }
    }
  }
}

TEST(CorneringSupply, ShrinksWithEveryNarrowerSlipAngleLimit) {
  const VehicleOnSoil on("lrv");
  double left_before = 1e9, right_before = -1e9;
  for (const double limit_deg : {30.0, 20.0, 16.0, 10.0, 5.0}) {
    TrimLimits limits = limits_of(on.vehicle);
    limits.slip_angle_max_rad = limit_deg * kDegree;
    const SupplyResult result = cornering_supply(on.manoeuvre(0.1), 0, limits);
    ASSERT_TRUE(result.supply) << limit_deg;
    EXPECT_LT(result.supply->left.force_n, left_before) << limit_deg;
    EXPECT_GT(result.supply->right.force_n, right_before) << limit_deg;
    left_before = result.supply->left.force_n;
    right_before = result.supply->right.force_n;
  }
}

TEST(CorneringSupply, IsLessOnWeakerSoil) {
  const VehicleOnSoil firm("lrv"), soft("lrv", soft_patch());
  for (const double k : {0.0, 0.2, 0.5}) {
    const SupplyResult on_firm = firm.supply(k), on_soft = soft.supply(k);
    ASSERT_TRUE(on_firm.supply && on_soft.supply);
    EXPECT_LT(on_soft.supply->left.force_n, 0.9 * on_firm.supply->left.force_n);
    EXPECT_GT(on_soft.supply->right.force_n, 0.9 * on_firm.supply->right.force_n);
  }
}

TEST(CorneringSupply, IsNoneForWantOfTractionOnASlopeTooSteepToClimb) {
  const VehicleOnSoil on("lrv");
  const double slope = 40 * kDegree;
  const SteadyManoeuvre manoeuvre(on.vehicle, on.sharing, on.wheel_laws, 0,
                                  on.weight_n() * std::cos(slope));
  const SupplyResult result =
      cornering_supply(manoeuvre, on.weight_n() * std::sin(slope), limits_of(on.vehicle));
  EXPECT_FALSE(result.supply);
  EXPECT_EQ(result.reason, NoSupply::kTraction);
}

TEST(CorneringSupply, IsNoneForWantOfTractionWhereTheMotorsAreTooWeakToRoll) {
  Vehicle vehicle = preset_vehicle("lrv");
  const VehicleOnSoil free(vehicle, firm_regolith(), kMoon_mps2);
  ASSERT_TRUE(free.supply(0).supply);
  vehicle.torque_max_nm = 0.5;
  const VehicleOnSoil on(vehicle, firm_regolith(), kMoon_mps2);
  const SupplyResult result = on.supply(0);
  EXPECT_FALSE(result.supply);
  EXPECT_EQ(result.reason, NoSupply::kTraction);
}

TEST(CorneringSupply, IsNoneForItsSinkageWhereTheVehicleSinksTooDeepInATrim) {
  Vehicle vehicle = preset_vehicle("lrv");
  const VehicleOnSoil free(vehicle, firm_regolith(), kMoon_mps2);
  ASSERT_TRUE(free.supply(0).supply);
  vehicle.sinkage_max_m = 0.001;
  const VehicleOnSoil on(vehicle, firm_regolith(), kMoon_mps2);
  const SupplyResult result = on.supply(0);
  EXPECT_FALSE(result.supply);
  EXPECT_EQ(result.reason, NoSupply::kSinkage);
  ASSERT_TRUE(result.too_deep);
  EXPECT_GT(result.too_deep->sinkage_m, vehicle.sinkage_max_m);
  EXPECT_EQ(result.too_deep->allowed_m, vehicle.sinkage_max_m);
}

TEST(CorneringSupply, IsNoneForItsSinkageWhereNothingKeepsAWheelFromItsAxle) {
  Vehicle vehicle = preset_vehicle("lrv");
  vehicle.mass_kg *= 100;
  for (const double allowed_m : {0.1, 1.0}) {
    vehicle.sinkage_max_m = allowed_m;
    const VehicleOnSoil on(vehicle, firm_regolith(), 9.81);
    const SupplyResult result = on.supply(0);
    EXPECT_FALSE(result.supply);
    EXPECT_EQ(result.reason, NoSupply::kSinkage);
    ASSERT_TRUE(result.too_deep);
    EXPECT_EQ(result.too_deep->sinkage_m, vehicle.wheel.radius_m);
    EXPECT_EQ(result.too_deep->allowed_m, std::min(allowed_m, vehicle.wheel.radius_m));
  }
}

TEST(CorneringSupply, IsNoneForWantOfYawBalanceWhereFixedWheelsMustTurnTightly) {
  Vehicle vehicle = preset_vehicle("curiosity");
  vehicle.slip_angle_max_rad = 3 * kDegree;  // what the middle wheels have in such a turn
  const VehicleOnSoil on(vehicle, firm_regolith(), 3.72);
  ASSERT_TRUE(on.supply(0).supply);
  vehicle.turn_centre_x_m = -0.5;
  const VehicleOnSoil off(vehicle, firm_regolith(), 3.72);
  const SupplyResult result = off.supply(0.5);
  EXPECT_FALSE(result.supply);
  EXPECT_EQ(result.reason, NoSupply::kYaw);
}

TEST(CorneringSupply, TheSteeringRangeBindsNearFullLock) {
  // Braking straightens a turn; steering against it needs more lock than there is.
  const VehicleOnSoil on("lrv");
  const double k = on.vehicle.curvature_max_1pm;
  const SupplyResult gently = on.supply(k, -0.13 * on.weight_n());
  ASSERT_TRUE(gently.supply);
  EXPECT_EQ(gently.supply->left.limit, BranchLimit::kSteering);
  EXPECT_LT(gently.supply->left.force_n, 0.5 * on.supply(k).supply->left.force_n);
  const SupplyResult hard = on.supply(k, -0.2 * on.weight_n());
  EXPECT_FALSE(hard.supply);
  EXPECT_EQ(hard.reason, NoSupply::kYaw);
}

TEST(CorneringSupply, HoldsAtAnyWeightThatSharesTheLoadsAlike) {
  // Twice the mass at half the gravity is the same weight on the same wheels; only the soil's own
  // weight in the bulldozing force tells.
  Vehicle heavy = preset_vehicle("lrv");
  heavy.mass_kg *= 2;
  const VehicleOnSoil on("lrv"), other(heavy, firm_regolith(), kMoon_mps2 / 2);
  const double one = on.supply(0.1).supply->left.force_n;
  EXPECT_NEAR(other.supply(0.1).supply->left.force_n, one, 0.03 * one);
}

TEST(LargestTraction, IsWhatTheSupplyBranchesEndAt) {
  // A force pair on the edge of the lateral supply is on the edge of traction as well where the
  // same limit ends both.
  const VehicleOnSoil on("lrv");
  const double w = on.weight_n();
  const auto free = largest_traction_n(on.manoeuvre(0), {}, limits_of(on.vehicle));
  ASSERT_TRUE(free);
  EXPECT_TRUE(on.supply(0, *free - 0.01 * w).supply);
  EXPECT_FALSE(on.supply(0, *free + 0.01 * w).supply);
}

TEST(LargestTraction, FallsAsLateralForceIsHeld) {
  const VehicleOnSoil on("lrv");
  const double w = on.weight_n();
  double before = 1e9;
  for (const double left : {0.0, 0.1, 0.2, 0.3, 0.4, 0.5}) {
    const auto traction =
        largest_traction_n(on.manoeuvre(0.1), {.left_n = left * w}, limits_of(on.vehicle));
    ASSERT_TRUE(traction) << left;
    EXPECT_LT(*traction, before) << left;
    before = *traction;
  }
}

TEST(LargestTraction, DoesNotDependOnWhereItsBranchStarts) {
  const VehicleOnSoil on("lrv");
  const double w = on.weight_n();
  const auto from = [&](double forward) {
    return largest_traction_n(on.manoeuvre(0.1), {.forward_n = forward * w, .left_n = 0.2 * w},
                              limits_of(on.vehicle))
        .value_or(NAN);
  };
  EXPECT_NEAR(from(0.1), from(0), 2e-3 * w);
  EXPECT_NEAR(from(0.3), from(0), 2e-3 * w);
  EXPECT_NEAR(from(-0.2), from(0), 2e-3 * w);
}

TEST(LargestTraction, IsNoneWhereTheLateralForceIsNotSupplied) {
  const VehicleOnSoil on("lrv");
  EXPECT_FALSE(largest_traction_n(on.manoeuvre(0.1), {.left_n = 0.6 * on.weight_n()},
                                  limits_of(on.vehicle)));
}

TEST(LargestTraction, IsTheSameBackwardsForAVehicleThatIsItsOwnMirrorImage) {
  const VehicleOnSoil on("lrv");
  const auto ahead = largest_traction_n(on.manoeuvre(0.2), {.left_n = 300}, limits_of(on.vehicle));
  const auto back =
      largest_traction_n(on.manoeuvre(0.2, true), {.left_n = 300}, limits_of(on.vehicle));
  ASSERT_TRUE(ahead && back);
  EXPECT_NEAR(*ahead, *back, 1e-3 * on.weight_n());
}

/// The paper's closing claim (Yoshida & Ishigami 2004, Sec. VI), for a vehicle: all wheels at one
/// slip angle, slip held by the pull they have to give.
TEST(CorneringSupply, CollapsesBeyondASlipOfSixTenths) {
  const VehicleOnSoil on("lrv");
  const double beta = 16 * kDegree;
  const auto supply_n = [&](double slip) {
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const WheelForces forces = on.model.forces(on.weight_n() / 4, motion_at(slip, beta));
      sum += forces.fx_n * std::sin(beta) + forces.fy_n * std::cos(beta);
    }
    return sum;
  };
  EXPECT_LT(supply_n(0.8), 0.8 * supply_n(0.6));
  EXPECT_LT(supply_n(0.95), 0.6 * supply_n(0.6));
  double before = supply_n(0.6);
  for (double slip = 0.65; slip < 1; slip += 0.05) {
    EXPECT_LT(supply_n(slip), before) << slip;
    before = supply_n(slip);
  }
}

/// A whole vehicle, straight ahead, its body at a slip angle and its rims at a slip: the trim that
/// has them, whatever forces along the path balance it. Steering balances the yaw moment.
Trim held_trim(const VehicleOnSoil& on, double slip, double slip_angle_rad) {
  const SteadyManoeuvre manoeuvre = on.manoeuvre(0);
  ForceLine line{};
  // Scales of the unknowns.
  const double per_angle = 1 / manoeuvre.trim({1, 0, 0, 0}, line).body_slip_angle_rad;
  const double per_drive = 1 / (manoeuvre.trim({0, 0, 1, 0}, line).drive_factor - 1);
  SteadyManoeuvre::Point at{-slip_angle_rad * per_angle, 0, slip / (1 - slip) * per_drive, 0};
  const double c = std::cos(slip_angle_rad), s = -std::sin(slip_angle_rad);
  for (int i = 0; i < 300; ++i) {
    const auto missing = manoeuvre.residual(at, line);
    EXPECT_TRUE(missing);
    if (!missing) return {};
    line.from.forward_n += (c * (*missing)[0] + s * (*missing)[1]) * on.weight_n();
    line.from.left_n += (c * (*missing)[1] - s * (*missing)[0]) * on.weight_n();
    if (missing->head<2>().norm() > 1e-3) continue;  // the loads settle first
    SteadyManoeuvre::Point turned = at;
    turned[1] += 1e-3;
    const double slope = ((*manoeuvre.residual(turned, line))[2] - (*missing)[2]) / 1e-3;
    at[1] -= std::clamp((*missing)[2] / slope, -0.05, 0.05);
  }
  EXPECT_LT(manoeuvre.residual(at, line)->cwiseAbs().maxCoeff(), 1e-6);
  return manoeuvre.trim(at, line);
}

TEST(CorneringSupply, OfTrimsAtOneSlipAngleCollapsesBeyondASlipOfSixTenths) {
  // Not Curiosity: the pull of so much slip would lift wheels off its bogies.
  for (const char* name : {"lrv", "tohoku"}) {
    const VehicleOnSoil on(name);
    const auto side_n = [&](double slip) { return held_trim(on, slip, 16 * kDegree).force.left_n; };
    const double at_six_tenths = side_n(0.6);
    EXPECT_GT(at_six_tenths, 0.1 * on.weight_n()) << name;
    double before = at_six_tenths;
    for (const double slip : {0.65, 0.7, 0.75, 0.8, 0.85, 0.9, 0.95}) {
      const double now = side_n(slip);
      EXPECT_LT(now, before) << name << slip;
      before = now;
    }
    EXPECT_LT(before, 0.6 * at_six_tenths) << name;
  }
}

TEST(CorneringSupply, OfTrimsAtOneSlipOverturnsMoreEasilyAtLargerSlipAngles) {
  for (const std::string& name : preset_vehicle_names()) {
    const VehicleOnSoil on(name);
    const SupportPolygon polygon(on.vehicle);
    double before = 1;
    for (const double angle_deg : {2.0, 4.0, 8.0, 12.0, 16.0, 20.0, 24.0}) {
      const Trim trim = held_trim(on, 0.2, angle_deg * kDegree);
      const double margin =
          polygon.tip_over_margin({.normal_n = on.weight_n(), .left_n = trim.force.left_n});
      EXPECT_LT(margin, before) << name << angle_deg;
      before = margin;
    }
    EXPECT_LT(before, 0.85) << name;
  }
}

TEST(CorneringSupply, LargerSlipAnglesOverturnMoreEasily) {
  // What the soil gives sideways at a larger slip angle brings a vehicle nearer to tipping over.
  const VehicleOnSoil on("lrv");
  const SupportPolygon polygon(on.vehicle);
  double before = 1;
  for (const double limit_deg : {4.0, 8.0, 12.0, 16.0, 25.0, 35.0}) {
    TrimLimits limits = limits_of(on.vehicle);
    limits.slip_angle_max_rad = limit_deg * kDegree;
    const SupplyResult result = cornering_supply(on.manoeuvre(0.1), 0, limits);
    ASSERT_TRUE(result.supply);
    const double margin = polygon.tip_over_margin(
        {.normal_n = on.weight_n(), .forward_n = 0, .left_n = result.supply->left.force_n});
    EXPECT_LT(margin, before) << limit_deg;
    before = margin;
  }
}

TEST(CorneringSupply, TellsWhichAxleLetsGoAndHowItHandles) {
  // On loose soil the heavier axle digs in and holds more than its share: weight on the nose lets
  // the tail go first, and the vehicle must be steered back.
  for (const double shift_m : {-0.4, 0.4}) {
    Vehicle vehicle = preset_vehicle("lrv");
    for (WheelMount& wheel : vehicle.wheels) wheel.x_m += shift_m;
    vehicle.turn_centre_x_m = shift_m;
    vehicle.cg_height_m = 0.3;
    const VehicleOnSoil on(vehicle, firm_regolith(), kMoon_mps2);
    const SupplyResult result = on.supply(0.02);
    ASSERT_TRUE(result.supply);
    for (const SupplyEnd& end : {result.supply->left, result.supply->right}) {
      EXPECT_EQ(end.limit, BranchLimit::kSlipAngle);
      const bool front = end.axle_x_m > 0;
      EXPECT_EQ(front, shift_m > 0) << shift_m;
      EXPECT_EQ(end.understeer_1pm > 0, front) << shift_m << ' ' << end.understeer_1pm;
    }
  }
}

TEST(CorneringSupply, EndsWhereAMotorIsTooWeak) {
  Vehicle vehicle = preset_vehicle("lrv");
  vehicle.torque_max_nm = 25;
  const VehicleOnSoil on(vehicle, firm_regolith(), kMoon_mps2);
  const SupplyResult result = on.supply(0.05, 0.05 * on.weight_n());
  ASSERT_TRUE(result.supply);
  EXPECT_EQ(result.supply->left.limit, BranchLimit::kTorque);
}

}  // namespace
}  // namespace regoplan
