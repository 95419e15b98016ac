#include "planner/terrain_rasters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "planner/world.h"
#include "tests/planner/flat_problem.h"

namespace regoplan {
namespace {

PlanningProblem on_slope(double slope) {
  return lrv_problem(
      one_soil_map(20, firm_regolith(), [slope](double x_m, double) { return slope * x_m; }));
}

float middle(const TerrainRasters& rasters, const std::vector<float>& values) {
  return values[static_cast<std::size_t>(rasters.frame.rows / 2) *
                    static_cast<std::size_t>(rasters.frame.columns) +
                static_cast<std::size_t>(rasters.frame.columns / 2)];
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

TEST(TerrainRasters, ATurnIsSafeUpToTheSupplyAndNotBeyond) {
  PlanningProblem problem = on_slope(0);
  problem.speed_max_mps = 3;
  const TerrainRasters rasters = terrain_rasters(problem);
  const double supply_n = static_cast<double>(middle(rasters, rasters.supply_n.back()));
  const double k = supply_n / (problem.vehicle.mass_kg * 9);
  ASSERT_LT(k, 0.9 * problem.vehicle.curvature_max_1pm);
  const World world(problem, WorldUse::kVerdict, 1);
  const auto judged = [&](double curvature_1pm) {
    return world.judge(world.dynamics().rolling_state(10, 10, 0, 3, curvature_1pm), {}, 0);
  };
  EXPECT_FALSE(judged(0.98 * k).rejected);
  EXPECT_TRUE(judged(1.03 * k).rejected);
}

TEST(TerrainRasters, TheMarginIsTheSmallestOfAllHeadings) {
  const PlanningProblem problem = on_slope(std::tan(10 * kTestDegree));
  const TerrainRasters rasters = terrain_rasters(problem);
  const double margin = static_cast<double>(middle(rasters, rasters.margin));
  const World world(problem, WorldUse::kVerdict, 1);
  double least = 1;
  for (int i = 0; i < 12; ++i) {
    const auto state = world.dynamics().rolling_state(10, 10, i * 30 * kTestDegree, 0.01);
    least = std::min(least, world.judge(state, {}, 0).point.margin);
  }
  EXPECT_NEAR(margin, least, 2e-3);
}

TEST(TerrainRasters, NothingIsKnownBeyondTheSlopeLimitAndAtTheEdge) {
  const PlanningProblem steep = on_slope(1);
  const TerrainRasters none = terrain_rasters(steep);
  for (const float value : none.margin) EXPECT_TRUE(std::isnan(value));
  const TerrainRasters level = terrain_rasters(on_slope(0));
  EXPECT_TRUE(std::isnan(level.margin.front()));
  EXPECT_FALSE(std::isnan(middle(level, level.margin)));
}

}  // namespace
}  // namespace regoplan
