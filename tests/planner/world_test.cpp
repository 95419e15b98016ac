#include "planner/problem/world.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/planner/flat_problem.h"

namespace regoplan {
namespace {

VehicleState moving(const World& world, double speed_mps, double curvature_1pm) {
  return world.dynamics().rolling_state(25, 25, 0, speed_mps, curvature_1pm);
}

std::optional<Rejection> reason(const std::optional<RejectedState>& rejected) {
  if (!rejected) return std::nullopt;
  return rejected->reason;
}

}  // namespace

TEST(World, ATurnThatTheSoilCanHoldIsAcceptedAndATighterOneIsRejectedForCornering) {
  const PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat));
  const World world(problem, WorldUse::kVerdict, 1);
  // 3 m/s on 20 m and on 10 m: .28 and .56 of the lunar weight; the soil gives about .53
  EXPECT_EQ(reason(world.rejected(moving(world, 3, 1 / 20.0), {})), std::nullopt);
  EXPECT_EQ(reason(world.rejected(moving(world, 3, 1 / 10.0), {})), Rejection::kCornering);
}

TEST(World, AVehicleThatPloughsStraightOnAtFullLockIsRejectedForCornering) {
  const PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat));
  const World world(problem, WorldUse::kVerdict, 1);
  VehicleState ploughing = moving(world, 3, 0);  // neither turns nor slides
  ploughing.curvature_1pm = problem.vehicle.curvature_max_1pm;
  EXPECT_EQ(reason(world.rejected(ploughing, {})), Rejection::kCornering);
}

TEST(World, EachLimitIsTheReasonWhenItAloneIsBroken) {
  const PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat));
  const World world(problem, WorldUse::kVerdict, 1);
  const VehicleState state = moving(world, 1, 0);
  const Limits& limits = problem.limits;
  EXPECT_EQ(reason(world.rejected(state, {.sinkage_m = 1.01 * limits.sinkage_max_m})),
            Rejection::kSinkage);
  EXPECT_EQ(reason(world.rejected(state, {.slip = -1.01 * limits.slip_max})), Rejection::kSlip);
  EXPECT_EQ(reason(world.rejected(state, {.slip_angle_rad = -1.01 * limits.slip_angle_max_rad})),
            Rejection::kSlipAngle);
  EXPECT_EQ(reason(world.rejected(moving(world, 3.1, 0), {})), Rejection::kSpeed);
  VehicleState outside = state;
  outside.x_m = -1;
  EXPECT_EQ(reason(world.rejected(outside, {})), Rejection::kBounds);
  VehicleState at_the_edge = state;
  at_the_edge.x_m = 0.5;  // the rear wheels stand beyond the map
  EXPECT_EQ(reason(world.rejected(at_the_edge, {})), Rejection::kUnknownTerrain);
}

TEST(World, GroundOfJustTheSteepestSlopeThatIsAllowedIsHeld) {
  // Heights are single precision: planes come out steeper than they were meant by a hair.
  for (const double slope_deg : {5.0, 7.5, 10.0, 15.0, 20.0}) {
    const double rise = std::tan(slope_deg * kTestDegree);
    PlanningProblem problem = lrv_problem(
        one_soil_map(50, firm_regolith(), [&](double, double y_m) { return rise * y_m; }));
    for (const double share : {1.0, 0.999}) {
      problem.limits.slope_max_rad = share * slope_deg * kTestDegree;
      const World world(problem, WorldUse::kVerdict, 1);
      for (const double x_m : {10.0, 20.3, 31.7}) {
        const VehicleState state = world.dynamics().rolling_state(x_m, 25.1, 0, 1, 0);
        EXPECT_EQ(reason(world.rejected(state, {}, {})),
                  share < 1 ? std::optional(Rejection::kSlope) : std::nullopt)
            << slope_deg << " deg at x = " << x_m;
      }
    }
  }
}

TEST(RejectedBy, EachMarginIsHeldAgainstTheLeastThatIsAllowed) {
  constexpr double kLeast = 0.05, kEnough = 0.06, kShort = 0.04;
  const auto margins = [](double traction, double tip_over, double cornering) {
    return StateMargins{.supply = SupplyInterval{.right_n = -100, .left_n = 100},
                        .tip_over = tip_over,
                        .cornering = cornering,
                        .traction = traction};
  };
  const auto why = [&](const StateMargins& found) {
    return reason(rejected_by(found, kLeast, {}));
  };
  EXPECT_EQ(why(margins(kEnough, kEnough, kEnough)), std::nullopt);
  EXPECT_EQ(why(margins(kShort, kEnough, kEnough)), Rejection::kTraction);
  EXPECT_EQ(why(margins(kEnough, kShort, kEnough)), Rejection::kTipOver);
  EXPECT_EQ(why(margins(kEnough, kEnough, kShort)), Rejection::kCornering);
  EXPECT_EQ(why(margins(kShort, kShort, kShort)), Rejection::kTraction);
  const auto tipping = rejected_by(margins(kEnough, kShort, kEnough), kLeast, {.x_m = 3});
  EXPECT_EQ(tipping->exceeded->found, kShort);
  EXPECT_EQ(tipping->exceeded->limit, kLeast);
  EXPECT_EQ(tipping->x_m, 3);
}

TEST(RejectedBy, WithoutASteadyTrimThereIsNoNumber) {
  const auto none = rejected_by({.no_supply = NoSupply::kYaw, .tip_over = 1}, 0, {});
  EXPECT_EQ(reason(none), Rejection::kCornering);
  EXPECT_FALSE(none->exceeded);
  EXPECT_EQ(reason(rejected_by({.no_supply = NoSupply::kTraction, .tip_over = 1}, 0, {})),
            Rejection::kTraction);
}

TEST(RejectedBy, AWheelThatSinksTooDeepIsToldBeforeAnyWantOfForce) {
  const auto deep = rejected_by({.no_supply = NoSupply::kSinkage,
                                 .too_deep = TooDeep{.sinkage_m = 0.009, .allowed_m = 0.005},
                                 .tip_over = -1},
                                0.05, {.x_m = 3});
  EXPECT_EQ(reason(deep), Rejection::kSinkage);
  EXPECT_EQ(deep->exceeded->found, 0.009);
  EXPECT_EQ(deep->exceeded->limit, 0.005);
  EXPECT_EQ(deep->x_m, 3);
}

TEST(World, AVehicleThatStandsDeeperThanItMayIsToldItsSinkage) {
  PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat));
  const World free(problem, WorldUse::kVerdict, 1);
  ASSERT_EQ(reason(free.rejected(free.start(), {})), std::nullopt);
  problem.limits.sinkage_max_m = 0.001;
  const World world(problem, WorldUse::kVerdict, 1);
  const auto rejected = world.rejected(world.start(), {});
  EXPECT_EQ(reason(rejected), Rejection::kSinkage);
  EXPECT_GT(rejected->exceeded->found, problem.limits.sinkage_max_m);
  EXPECT_LT(rejected->exceeded->found, problem.vehicle.sinkage_max_m);
  EXPECT_EQ(rejected->exceeded->limit, problem.limits.sinkage_max_m);
}

TEST(World, ASearchMayStartAtTopSpeedThoughItKeepsAReserveBelowIt) {
  PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat));
  problem.start.speed_mps = problem.speed_max_mps;
  const World world(problem, WorldUse::kSearch, 1);
  EXPECT_EQ(reason(world.rejected(world.start(), {})), std::nullopt);
}

TEST(World, WhatASearchRefusesForItsReserveBreaksTheLimitThatItTells) {
  const PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat));
  const World searched(problem, WorldUse::kSearch, 1), verdict(problem, WorldUse::kVerdict, 1);
  const Limits& limits = problem.limits;
  constexpr double kWithinTheReserve = 0.998;
  const VehicleState slow = moving(searched, 1, 0);
  struct Case {
    VehicleState state;
    WheelStrain strain;
    Rejection reason;
  };
  for (const Case& one :
       {Case{moving(searched, kWithinTheReserve * problem.speed_max_mps, 0), {}, Rejection::kSpeed},
        Case{slow, {.sinkage_m = kWithinTheReserve * limits.sinkage_max_m}, Rejection::kSinkage},
        Case{slow, {.slip = -kWithinTheReserve * limits.slip_max}, Rejection::kSlip}}) {
    EXPECT_EQ(reason(verdict.rejected(one.state, one.strain)), std::nullopt);
    const auto refused = searched.rejected(one.state, one.strain);
    ASSERT_EQ(reason(refused), one.reason);
    EXPECT_GT(std::abs(refused->exceeded->found), refused->exceeded->limit);
  }
}

TEST(World, ASearchKeepsAReserveToTheEdgeOfTheMap) {
  const PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat));
  const World world(problem, WorldUse::kSearch, 1), verdict(problem, WorldUse::kVerdict, 1);
  const auto at = [&](double y_m) { return world.dynamics().rolling_state(25, y_m, 0, 1); };
  double lowest_m = 5;  // that the verdict accepts
  while (!verdict.rejected(at(lowest_m), {})) lowest_m -= 0.01;
  EXPECT_EQ(reason(verdict.rejected(at(lowest_m), {})), Rejection::kUnknownTerrain);
  EXPECT_EQ(reason(world.rejected(at(lowest_m + 0.05), {})), Rejection::kUnknownTerrain);
  EXPECT_EQ(reason(world.rejected(at(lowest_m + 0.15), {})), std::nullopt);
}

TEST(World, TheReserveToTheEdgeIsKeptForWheelsFarOutsideASmallBodyToo) {
  for (const double cell_m : {0.5, 0.05}) {
    PlanningProblem problem = lrv_problem(one_soil_map(8, firm_regolith(), flat, {}, cell_m));
    problem.start = {.x_m = 4, .y_m = 4};
    problem.goal = {.x_m = 4, .y_m = 4, .radius_m = 1, .heading_rad = {}};
    problem.vehicle.body.x_min_m = problem.vehicle.body.y_min_m = -0.2;
    problem.vehicle.body.x_max_m = problem.vehicle.body.y_max_m = 0.2;
    const World world(problem, WorldUse::kSearch, 1), verdict(problem, WorldUse::kVerdict, 1);
    const WheelMount& wheel = problem.vehicle.wheels.front();
    // One wheel points straight at the edge.
    const double yaw_rad = std::numbers::pi - std::atan2(wheel.y_m, wheel.x_m);
    const auto at = [&](double x_m) { return world.dynamics().rolling_state(x_m, 4, yaw_rad, 1); };
    double lowest_m = 4;  // that the verdict accepts
    while (!verdict.rejected(at(lowest_m), {})) lowest_m -= 0.005;
    EXPECT_NEAR(lowest_m, std::hypot(wheel.x_m, wheel.y_m), 0.01);
    EXPECT_EQ(reason(world.rejected(at(lowest_m + 0.09), {})), Rejection::kUnknownTerrain);
    EXPECT_EQ(reason(world.rejected(at(lowest_m + 0.15), {})), std::nullopt);
  }
}

TEST(World, ASearchKeepsTheSameReserveToUnknownGroundInsideTheMap) {
  const auto hole = [](double /*x*/, double y) { return std::abs(y - 15) < 5 ? NAN : 0.0; };
  const PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), hole));
  const World world(problem, WorldUse::kSearch, 1), verdict(problem, WorldUse::kVerdict, 1);
  const auto at = [&](double y_m) { return world.dynamics().rolling_state(25, y_m, 0, 1); };
  double lowest_m = 25;  // that the verdict accepts
  while (!verdict.rejected(at(lowest_m), {})) lowest_m -= 0.01;
  EXPECT_EQ(reason(verdict.rejected(at(lowest_m), {})), Rejection::kUnknownTerrain);
  EXPECT_EQ(reason(world.rejected(at(lowest_m + 0.05), {})), Rejection::kUnknownTerrain);
  EXPECT_EQ(reason(world.rejected(at(lowest_m + 0.15), {})), std::nullopt);
}

TEST(World, ASteepSlopeIsRejectedForSlopeAndASofterLimitForTraction) {
  const auto slope = [](double x, double /*y*/) { return std::tan(28 * kTestDegree) * x; };
  PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), slope));
  const World strict(problem, WorldUse::kVerdict, 1);
  EXPECT_EQ(reason(strict.rejected(moving(strict, 1, 0), {})), Rejection::kSlope);
  problem.limits.slope_max_rad = 40 * kTestDegree;
  UncertainSoil weak = firm_regolith();
  weak.mean.friction_angle_rad = 20 * kTestDegree;
  PlanningProblem weak_problem = lrv_problem(one_soil_map(50, weak, slope));
  weak_problem.limits.slope_max_rad = 40 * kTestDegree;
  const World climbing(weak_problem, WorldUse::kVerdict, 1);
  EXPECT_EQ(reason(climbing.rejected(moving(climbing, 1, 0), {})), Rejection::kTraction);
}

TEST(World, WhatASearchAcceptsTheVerdictAcceptsToo) {
  const auto rolling = [](double x, double y) {
    return 1.5 * std::sin(x / 6) + 1.2 * std::cos(y / 5);
  };
  const PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), rolling));
  const World search(problem, WorldUse::kSearch, 2);
  const World verdict(problem, WorldUse::kVerdict, 1);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  int accepted = 0, overturned = 0;
  for (int i = 0; i < 400; ++i) {
    VehicleState state = search.dynamics().rolling_state(
        25 + 20 * unit(random), 25 + 20 * unit(random), 3 * unit(random), 1.5 + 1.5 * unit(random),
        0.15 * unit(random));
    state.rim_acceleration_mps2 = 0.3 * unit(random);
    if (search.rejected(state, {}, problem.limits.margin_min + 0.01)) continue;
    ++accepted;
    if (verdict.rejected(state, {})) ++overturned;
  }
  EXPECT_GT(accepted, 100);
  EXPECT_EQ(overturned, 0);
}

TEST(World, AStepOfTheSearchStaysWithinACell) {
  const PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat));
  const World world(problem, WorldUse::kVerdict, 1);
  EXPECT_LE(world.search_step_s() * problem.speed_max_mps, 0.5);
  EXPECT_GT(world.search_step_s(), 0);
}

}  // namespace regoplan
