#include "terramech/margins/trim_branch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/terramech/lunar_soil.h"

namespace regoplan {
namespace {

ForceLine sideways(const VehicleOnSoil& on, double forward_n, double direction) {
  return {.from = {.forward_n = forward_n, .left_n = 0},
          .per_unit = {.forward_n = 0, .left_n = direction * on.weight_n()}};
}

/// Trims on the way from no lateral force to p, found by small steps of p and Newton's method: no
/// arc length, no tangents.
std::vector<LimitUse> uses_on_the_way(const VehicleOnSoil& on, double curvature_1pm,
                                      const ForceLine& line, double p) {
  const SteadyManoeuvre manoeuvre = on.manoeuvre(curvature_1pm);
  auto at = manoeuvre.solve_from_rolling(line);
  std::vector<LimitUse> uses;
  constexpr int kSteps = 60;
  for (int i = 0; i <= kSteps; ++i) {
    if (!at) return {};
    (*at)[3] = p * i / kSteps;
    at = manoeuvre.solve(*at, line);
    if (!at) return {};
    uses.push_back(limit_use(manoeuvre.trim(*at, line), limits_of(on.vehicle)));
  }
  return uses;
}

BranchEnd end_of(const VehicleOnSoil& on, double curvature_1pm, const ForceLine& line,
                 const TrimLimits& limits, double target_p = 20) {
  const SteadyManoeuvre manoeuvre = on.manoeuvre(curvature_1pm);
  const auto start = manoeuvre.solve_from_rolling(line);
  EXPECT_TRUE(start);
  return follow_branch(manoeuvre, *start, line, target_p, limits, true);
}

TEST(TrimBranch, IsConnectedToItsStartAndEndsAtTheFirstLimit) {
  for (const std::string& name : preset_vehicle_names()) {
    const VehicleOnSoil on(name);
    for (const double share : {0.0, 0.5, -0.9}) {
      for (const double direction : {-1.0, 1.0}) {
        const double k = share * on.vehicle.curvature_max_1pm;
        const ForceLine line = sideways(on, 0.1 * on.weight_n(), direction);
        const BranchEnd end = end_of(on, k, line, limits_of(on.vehicle));
        const std::vector<LimitUse> uses = uses_on_the_way(on, k, line, end.p);
        ASSERT_FALSE(uses.empty()) << name << k;
        for (std::size_t i = 0; i + 1 < uses.size(); ++i) EXPECT_LT(uses[i].used, 1) << name << k;
        EXPECT_NEAR(uses.back().used, 1, 1e-3) << name << k;
        EXPECT_EQ(uses.back().limit, end.limit) << name << k;
        EXPECT_EQ(uses.back().wheel, end.wheel) << name << k;
      }
    }
  }
}

TEST(TrimBranch, TheFoldLiesBeyondTheLimitAndNoTrimBeyondTheFold) {
  const VehicleOnSoil on("lrv");
  const ForceLine line = sideways(on, 0, 1);
  const BranchEnd end = end_of(on, 0.1, line, limits_of(on.vehicle));
  ASSERT_TRUE(end.fold_p);
  EXPECT_GT(*end.fold_p, end.p);
  const SteadyManoeuvre manoeuvre = on.manoeuvre(0.1);
  SteadyManoeuvre::Point at = end.point;
  for (at[3] = end.p; at[3] < *end.fold_p - 2e-4; at[3] += 1e-4) {
    const auto there = manoeuvre.solve(at, line);
    ASSERT_TRUE(there) << at[3];
    at = *there;
  }
  at[3] = *end.fold_p + 2e-3;
  EXPECT_FALSE(manoeuvre.solve(at, line));
}

TEST(TrimBranch, WithoutLimitsEndsAtTheFold) {
  const VehicleOnSoil on("lrv");
  const TrimLimits none{
      .slip_angle_max_rad = 10, .slip_max = 10, .sinkage_max_m = 10, .steer_angle_max_rad = 10};
  const ForceLine line = sideways(on, 0, 1);
  const BranchEnd end = end_of(on, 0.1, line, none);
  EXPECT_EQ(end.limit, BranchLimit::kFold);
  EXPECT_NEAR(end.p, *end_of(on, 0.1, line, limits_of(on.vehicle)).fold_p, 1e-5);
}

TEST(TrimBranch, EachLimitStopsItWhenItIsTheTightest) {
  const VehicleOnSoil on("lrv");
  const ForceLine line = sideways(on, 0.2 * on.weight_n(), 1);
  const TrimLimits wide{.slip_angle_max_rad = 40 * kDegree,
                        .slip_max = 0.9,
                        .sinkage_max_m = 0.3,
                        .steer_angle_max_rad = 50 * kDegree};
  TrimLimits limits = wide;
  limits.slip_max = 0.2;
  EXPECT_EQ(end_of(on, 0.1, line, limits).limit, BranchLimit::kSlip);
  limits = wide;
  limits.sinkage_max_m = 0.02;
  EXPECT_EQ(end_of(on, 0.1, line, limits).limit, BranchLimit::kSinkage);
  limits = wide;
  limits.slip_angle_max_rad = 10 * kDegree;
  EXPECT_EQ(end_of(on, 0.1, line, limits).limit, BranchLimit::kSlipAngle);
  limits = wide;
  limits.steer_angle_max_rad = 50 * kDegree;
  const double lock = on.vehicle.curvature_max_1pm;
  EXPECT_EQ(end_of(on, lock, sideways(on, -0.1 * on.weight_n(), 1), limits).limit,
            BranchLimit::kSteering);
  Vehicle tall = on.vehicle;
  tall.cg_height_m = 2.5;
  const VehicleOnSoil on_tall(tall, firm_regolith(), kMoon_mps2);
  const BranchEnd lifted = end_of(on_tall, 0.1, sideways(on_tall, 0.05 * on.weight_n(), 1), wide);
  EXPECT_EQ(lifted.limit, BranchLimit::kLiftedWheel);
  EXPECT_EQ(lifted.wheel, 0);  // the inner front wheel of a vehicle that speeds up to the left
}

TEST(TrimBranch, StopsAtItsTargetWhereNoLimitComesFirst) {
  const VehicleOnSoil on("lrv");
  for (const double target : {0.0, 1e-6, 0.1, 0.4, 0.5}) {
    const BranchEnd end = end_of(on, 0.1, sideways(on, 0, 1), limits_of(on.vehicle), target);
    EXPECT_TRUE(end.reached_target) << target;
    EXPECT_EQ(end.p, target);
    const auto missing = on.manoeuvre(0.1).residual(end.point, sideways(on, 0, 1));
    ASSERT_TRUE(missing);
    EXPECT_LT(missing->cwiseAbs().maxCoeff(), 1e-4) << target;
  }
  EXPECT_FALSE(end_of(on, 0.1, sideways(on, 0, 1), limits_of(on.vehicle), 0.6).reached_target);
}

TEST(TrimBranch, GoesAsFarToTheLeftAsToTheRightWhenItStartsOnAKink) {
  // Straight ahead, side slip sets in at zero, where the wheels' forces have a corner; near the end
  // of traction it is sharpest.
  for (const Soil& soil : {firm_regolith(), soft_patch()}) {
    const VehicleOnSoil on("lrv", soil);
    for (double forward = -0.6; forward < 0.55; forward += 0.05) {
      const ForceLine left = sideways(on, forward * on.weight_n(), 1);
      const ForceLine right = sideways(on, forward * on.weight_n(), -1);
      if (!on.manoeuvre(0).solve_from_rolling(left)) continue;
      EXPECT_NEAR(end_of(on, 0, left, limits_of(on.vehicle)).p,
                  end_of(on, 0, right, limits_of(on.vehicle)).p, 2e-4)
          << forward;
    }
  }
}

TEST(BranchLimit, HasAName) {
  EXPECT_EQ(name(BranchLimit::kFold), "fold");
  EXPECT_EQ(name(BranchLimit::kSteering), "steering range");
}

}  // namespace
}  // namespace regoplan
