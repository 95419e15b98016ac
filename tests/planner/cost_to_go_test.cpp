#include "planner/certificate/cost_to_go.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "planner/certificate/steepest_climb.h"
#include "tests/planner/flat_problem.h"

namespace regoplan {
namespace {

constexpr double kClimb_rad = 20 * kTestDegree;

CostToGo way_of(const PlanningProblem& problem) {
  return {problem, std::vector<std::optional<double>>(problem.map.soils().size(), kClimb_rad), 0,
          1};
}

/// A wall of rocks across x = 25 m with a gate of that width at y.
std::vector<Rock> wall_with_gate(double y_m, double width_m) {
  std::vector<Rock> wall;
  for (double away = width_m / 2 + 0.6; away <= 50; away += 0.8) {
    for (const double side : {-1.0, 1.0}) wall.push_back({25, y_m + side * away, 0.6, 2});
  }
  return wall;
}

/// Where the way from the start crosses the wall.
double crossing_y_m(const CostToGo& way, const PlanningProblem& problem) {
  CostToGo::Place before{problem.start.x_m, problem.start.y_m};
  for (double ahead_m = 0.5; before.x_m < 25; ahead_m += 0.5) {
    const CostToGo::Place at = way.ahead(problem.start.x_m, problem.start.y_m, ahead_m);
    if (at.x_m >= 25) {
      return std::lerp(before.y_m, at.y_m, (25 - before.x_m) / (at.x_m - before.x_m));
    }
    before = at;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

/// Firm ground and, as code 2, dust that does not carry an LRV.
PlanningProblem beside_dust() {
  UncertainSoil dust = firm_regolith();
  dust.mean.kphi = 2e4;
  dust.mean.kc = 100;
  dust.mean.cohesion_pa = 20;
  const TerrainMap level = one_soil_map(50, firm_regolith(), flat);
  ClassRaster classes{.frame = level.elevation().frame, .code = {}};
  for (int row = 0; row < classes.frame.rows; ++row) {
    for (int column = 0; column < classes.frame.columns; ++column) {
      const double x = (column + 0.5) / 2, y = 50 - (row + 0.5) / 2;
      classes.code.push_back(std::abs(x - 25) < 5 && y < 40 ? 2 : 1);
    }
  }
  SoilCatalogue soils{.soils = {{.name = "firm", .source = "test", .soil = firm_regolith()},
                                {.name = "dust", .source = "test", .soil = dust}},
                      .classes = {{1, 0}, {2, 1}},
                      .unmapped = {}};
  return lrv_problem({level.elevation(), std::move(classes), std::move(soils), {}});
}

}  // namespace

TEST(CostToGo, TheWayLeadsThroughTheMiddleOfAGateWhereverItsCellsLie) {
  for (const double gate_y_m : {30.0, 30.3, 30.5, 30.8}) {
    const PlanningProblem problem =
        lrv_problem(one_soil_map(50, firm_regolith(), flat, wall_with_gate(gate_y_m, 2.5)));
    EXPECT_NEAR(crossing_y_m(way_of(problem), problem), gate_y_m, 0.1);
  }
}

TEST(CostToGo, AGateTooNarrowForTheVehicleIsNoWay) {
  // The narrow gate stands on the straight way, the other far aside.
  std::vector<Rock> rocks = wall_with_gate(40, 2.5);
  std::erase_if(rocks, [](const Rock& rock) { return std::abs(rock.y_m - 25) < 1; });
  const PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat, rocks));
  EXPECT_NEAR(crossing_y_m(way_of(problem), problem), 40, 0.1);
}

TEST(CostToGo, ItLeadsRoundSoilThatDoesNotCarryTheVehicle) {
  const PlanningProblem problem = beside_dust();
  const World world(problem, WorldUse::kSearch, 1);
  const CostToGo way(problem, steepest_climbs_rad(world), 0, 1);
  EXPECT_GT(crossing_y_m(way, problem), 40);
}

TEST(SteepestClimb, DustThatSwallowsTheWheelsIsNotDrivenOnAtAll) {
  const PlanningProblem problem = beside_dust();
  const World world(problem, WorldUse::kSearch, 1);
  const std::vector<std::optional<double>> climbs = steepest_climbs_rad(world);
  ASSERT_EQ(climbs.size(), 2u);
  EXPECT_FALSE(climbs[1]);
  ASSERT_TRUE(climbs[0]);
  EXPECT_GT(*climbs[0], 0);
  EXPECT_LE(*climbs[0], problem.limits.slope_max_rad);
}

TEST(SteepestClimb, WhatIsClimbedKeepsTheMarginAndASixteenthMoreDoesNot) {
  PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat));
  problem.limits.margin_min = 0.2;
  const World world(problem, WorldUse::kSearch, 1);
  const double climb = steepest_climbs_rad(world).front().value();
  const auto margin = [&](double slope_rad) {
    GroundPatch patch{.known = true, .slope_forward = std::tan(slope_rad)};
    return world.margins(world.dynamics().rolling_state(25, 25, 0, 1), patch).stability();
  };
  ASSERT_TRUE(margin(climb));
  EXPECT_GE(*margin(climb), 0.2);
  const auto beyond = margin(climb + problem.limits.slope_max_rad / 15);
  EXPECT_TRUE(!beyond || *beyond < 0.2);
}

}  // namespace regoplan
