#include "planner/chart/doubtful_soils.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planner/chart/feasibility_chart.h"
#include "planner/plan.h"
#include "tests/planner/flat_problem.h"

namespace regoplan {
namespace {

/// Bears an LRV at its mean with little to spare; how far its bearing scatters is for the test.
UncertainSoil soft_soil(double kphi_deviation) {
  UncertainSoil soil = firm_regolith();
  soil.mean.friction_angle_rad = 28 * kTestDegree;
  soil.mean.cohesion_pa = 50;
  soil.mean.kc = 100;
  soil.mean.kphi = 6e4;
  soil.standard_deviation.kphi = kphi_deviation;
  return soil;
}
constexpr double kWellKnown = 2e3, kHardlyKnown = 4.5e4;

/// Firm ground of 50 m by 50 m; across the straight way lies a strip of another soil that leaves
/// 12 m free at one side.
PlanningProblem across_a_strip(const UncertainSoil& strip) {
  const TerrainMap firm = one_soil_map(50, firm_regolith(), flat);
  ClassRaster classes{.frame = firm.elevation().frame, .code = {}};
  for (int row = 0; row < classes.frame.rows; ++row) {
    for (int column = 0; column < classes.frame.columns; ++column) {
      const double x_m = (column + 0.5) * classes.frame.cell_width_m;
      const double y_m = classes.frame.north_m - (row + 0.5) * classes.frame.cell_height_m;
      classes.code.push_back(std::abs(x_m - 25) < 4 && y_m < 38 ? 2 : 1);
    }
  }
  PlanningProblem problem = lrv_problem(
      {firm.elevation(),
       std::move(classes),
       SoilCatalogue{.soils = {{.name = "firm", .source = "test", .soil = firm_regolith()},
                               {.name = "strip", .source = "test", .soil = strip}},
                     .classes = {{1, 0}, {2, 1}},
                     .unmapped = {}},
       {}});
  problem.search.planner = "Lattice";
  problem.search.soil_draws = 40;
  return problem;
}

bool crosses_the_strip(const Candidate& path) {
  return std::ranges::any_of(path.points, [](const TrajectoryPoint& point) {
    return std::abs(point.x_m - 25) < 4 && point.y_m < 38;
  });
}

TEST(DoubtfulSoils, NoneIsThatIsKnownWell) {
  EXPECT_TRUE(doubtful_soils(across_a_strip(soft_soil(0))).empty());
  EXPECT_TRUE(doubtful_soils(across_a_strip(soft_soil(kWellKnown))).empty());
}

TEST(DoubtfulSoils, OneIsThatBearsTheVehicleAtItsMeanAndNotInManyDraws) {
  const PlanningProblem problem = across_a_strip(soft_soil(kHardlyKnown));
  EXPECT_EQ(doubtful_soils(problem), std::vector<std::string>{"strip"});
  EXPECT_GE(straight_on_margin(chart_settings(problem), 1, 0), problem.limits.margin_min);
}

TEST(DoubtfulSoils, WhatDoesNotBearTheVehicleAtItsMeanIsForbiddenAndNotDoubtful) {
  UncertainSoil bottomless = soft_soil(1e4);
  bottomless.mean.kphi = 1.5e4;
  EXPECT_TRUE(doubtful_soils(across_a_strip(bottomless)).empty());
}

TEST(Plan, GoesRoundASoilThatHalfOfItsDrawsDoNotBearAndAcrossOneThatIsKnown) {
  const PlanResult known = plan(across_a_strip(soft_soil(kWellKnown)));
  ASSERT_EQ(known.status, PlanStatus::kFeasible) << known.reason;
  EXPECT_TRUE(known.doubtful_soils.empty());
  EXPECT_TRUE(crosses_the_strip(known.candidates.front()));

  const PlanResult doubtful = plan(across_a_strip(soft_soil(kHardlyKnown)));
  ASSERT_EQ(doubtful.status, PlanStatus::kFeasible) << doubtful.reason;
  EXPECT_EQ(doubtful.doubtful_soils, std::vector<std::string>{"strip"});
  const Candidate& best = doubtful.candidates.front();
  EXPECT_FALSE(crosses_the_strip(best));
  EXPECT_TRUE(best.off_doubtful_soils);
  EXPECT_EQ(best.spread->feasible.share, 1);
}

TEST(Plan, ADoubtfulSoilThatLeavesNoWayRoundIsCrossedAndSaidToBeDoubtful) {
  PlanningProblem problem = lrv_problem(one_soil_map(50, soft_soil(kHardlyKnown), flat));
  problem.search.planner = "Lattice";
  const PlanResult result = plan(problem);
  ASSERT_EQ(result.status, PlanStatus::kFeasible) << result.reason;
  EXPECT_EQ(result.doubtful_soils, std::vector<std::string>{"regolith"});
  EXPECT_FALSE(result.candidates.front().off_doubtful_soils);
}

}  // namespace
}  // namespace regoplan
