#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planner/chart/margin_rasters.h"
#include "planner/problem/world.h"
#include "tests/planner/flat_problem.h"

namespace regoplan {
namespace {

PlanningProblem on_slope(double slope) {
  return lrv_problem(
      one_soil_map(20, firm_regolith(), [slope](double x_m, double) { return slope * x_m; }));
}

float middle(const GridFrame& frame, const std::vector<float>& values) {
  return values[static_cast<std::size_t>(frame.rows / 2) * static_cast<std::size_t>(frame.columns) +
                static_cast<std::size_t>(frame.columns / 2)];
}
float middle(const TerrainRasters& rasters, const std::vector<float>& values) {
  return middle(rasters.frame, values);
}

TEST(TerrainRasters, LieOnTheGridOfTheElevation) {
  const PlanningProblem problem = on_slope(0);
  const TerrainRasters rasters = terrain_rasters(problem);
  EXPECT_EQ(rasters.frame, problem.map.elevation().frame);
  ASSERT_EQ(rasters.supply_n.size(), rasters.speeds_mps.size());
  EXPECT_EQ(rasters.speeds_mps.back(), problem.speed_max_mps);
  for (const auto& values : rasters.supply_n) {
    EXPECT_EQ(values.size(), problem.map.elevation().height_m.size());
  }
}

TEST(TerrainRasters, TheSupplyIsThatOfTheTightestSafeTurn) {
  const PlanningProblem problem = on_slope(0);
  const TerrainRasters rasters = terrain_rasters(problem);
  const double supply_n = static_cast<double>(middle(rasters, rasters.supply_n.back()));
  const World world(problem, WorldUse::kVerdict, 1);
  const auto judged = [&](double curvature_1pm) {
    const double speed_mps = rasters.speeds_mps.back();
    return world.judge(world.dynamics().rolling_state(10, 10, 0, speed_mps, curvature_1pm), {}, 0);
  };
  double safe_1pm = 0, unsafe_1pm = problem.vehicle.curvature_max_1pm;
  ASSERT_TRUE(judged(unsafe_1pm).rejected);
  while (unsafe_1pm - safe_1pm > 1e-3 * unsafe_1pm) {
    const double middle_1pm = (safe_1pm + unsafe_1pm) / 2;
    (judged(middle_1pm).rejected ? unsafe_1pm : safe_1pm) = middle_1pm;
  }
  const TrajectoryPoint turn = judged(safe_1pm).point;
  EXPECT_NEAR(supply_n, std::min(turn.supply_max_n, -turn.supply_min_n), 0.01 * supply_n);
}

/// The verdict's smallest margin of driving slowly straight on, over the headings.
double least_margin(const PlanningProblem& problem) {
  const World world(problem, WorldUse::kVerdict, 1);
  double least = 1;
  for (int i = 0; i < 12; ++i) {
    const auto state = world.dynamics().rolling_state(10, 10, i * 30 * kTestDegree, 0.01);
    least = std::min(least, world.judge(state, {}, 0).point.margin);
  }
  return least;
}

TEST(TerrainRasters, TheMarginIsTheSmallestOfAllHeadings) {
  const PlanningProblem problem = on_slope(std::tan(10 * kTestDegree));
  const TerrainRasters rasters = terrain_rasters(problem);
  EXPECT_NEAR(static_cast<double>(middle(rasters, rasters.margin)), least_margin(problem), 2e-3);
}

TEST(TerrainRasters, WeakMotorsLeaveLessMargin) {
  PlanningProblem problem = on_slope(std::tan(10 * kTestDegree));
  const TerrainRasters strong = terrain_rasters(problem);
  const double climbing_nm = problem.vehicle.mass_kg * problem.gravity_mps2 *
                             std::sin(10 * kTestDegree) * problem.vehicle.wheel.radius_m / 4;
  problem.vehicle.torque_max_nm = 2 * climbing_nm;
  const TerrainRasters weak = terrain_rasters(problem);
  EXPECT_NEAR(static_cast<double>(middle(weak, weak.margin)), least_margin(problem), 2e-3);
  EXPECT_LT(middle(weak, weak.margin), middle(strong, strong.margin) - 0.02F);
}

TEST(TerrainRasters, NothingIsKnownBeyondTheSlopeLimitAndAtTheEdge) {
  const PlanningProblem steep = on_slope(1);
  const TerrainRasters none = terrain_rasters(steep);
  for (const float value : none.margin) EXPECT_TRUE(std::isnan(value));
  const TerrainRasters level = terrain_rasters(on_slope(0));
  EXPECT_TRUE(std::isnan(level.margin.front()));
  EXPECT_FALSE(std::isnan(middle(level, level.margin)));
}

/// Ground of a slope in the middle of the map, of soil whose friction is known to a deviation.
float probability_in_the_middle(double slope, double friction_std_rad) {
  PlanningProblem problem = on_slope(slope);
  std::vector<MapSoil> soils = problem.map.soils();
  soils.front().soil.standard_deviation.friction_angle_rad = friction_std_rad;
  problem.map = problem.map.with_soils(soils);
  return middle(problem.map.elevation().frame, straight_on_probability(problem));
}

TEST(TerrainRasters, WhatIsKnownHoldsOrDoesNot) {
  const double weak = std::tan(24 * kTestDegree);
  const PlanningProblem steep = on_slope(weak);
  const bool holds = least_margin(steep) >= steep.limits.margin_min;
  EXPECT_EQ(probability_in_the_middle(weak, 0), holds ? 1 : 0);
  EXPECT_EQ(probability_in_the_middle(0, 0), 1);
}

TEST(TerrainRasters, SteeperGroundHoldsInFewerDraws) {
  const double std_rad = 6 * kTestDegree;
  float before = 1;
  bool between = false;
  for (const double slope_deg : {0.0, 8.0, 12.0, 16.0, 20.0, 24.0}) {
    const float share = probability_in_the_middle(std::tan(slope_deg * kTestDegree), std_rad);
    EXPECT_LE(share, before) << slope_deg;
    between = between || (share > 0 && share < 1);
    before = share;
  }
  EXPECT_TRUE(between);
}

}  // namespace
}  // namespace regoplan
