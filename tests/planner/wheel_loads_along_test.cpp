#include "planner/driving/wheel_loads_along.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "tests/planner/flat_problem.h"

namespace regoplan {
namespace {

TrajectoryPoint driving_at(double curvature_1pm) {
  TrajectoryPoint point;
  point.x_m = 20;
  point.y_m = 20;
  point.speed_mps = 2;
  point.curvature_1pm = curvature_1pm;
  point.supply_min_n = -1e4;
  point.supply_max_n = 1e4;
  return point;
}

double sum(const std::vector<double>& loads) {
  return std::accumulate(loads.begin(), loads.end(), 0.0);
}

TEST(WheelLoadsAlong, TogetherCarryTheWeightOnLevelGround) {
  const PlanningProblem problem = lrv_problem(one_soil_map(60, firm_regolith(), flat));
  const double weight_n = problem.vehicle.mass_kg * problem.gravity_mps2;
  for (const double curvature : {0.0, 0.05, -0.1}) {
    const auto loads = wheel_loads_along_n(problem, std::vector{driving_at(curvature)});
    ASSERT_EQ(loads.size(), 1U);
    ASSERT_EQ(loads[0].size(), problem.vehicle.wheels.size());
    EXPECT_NEAR(sum(loads[0]), weight_n, 1e-9 * weight_n);
  }
}

TEST(WheelLoadsAlong, ATurnToTheLeftLoadsTheRight) {
  const PlanningProblem problem = lrv_problem(one_soil_map(60, firm_regolith(), flat));
  const auto loads = wheel_loads_along_n(problem, std::vector{driving_at(0.05)})[0];
  double left_n = 0, right_n = 0;
  for (std::size_t i = 0; i < loads.size(); ++i) {
    (problem.vehicle.wheels[i].y_m > 0 ? left_n : right_n) += loads[i];
  }
  // Sum N y = -h m v^2 k.
  const Vehicle& vehicle = problem.vehicle;
  const double track_m = 2 * std::abs(vehicle.wheels[0].y_m);
  EXPECT_NEAR((right_n - left_n) * track_m / 2,
              vehicle.cg_height_m * vehicle.mass_kg * 2 * 2 * 0.05, 0.02 * vehicle.mass_kg);
}

TEST(WheelLoadsAlong, OnUnknownGroundNothingIsKnown) {
  const PlanningProblem problem = lrv_problem(one_soil_map(60, firm_regolith(), flat));
  TrajectoryPoint outside = driving_at(0);
  outside.x_m = -1e4;
  const auto loads = wheel_loads_along_n(problem, std::vector{outside});
  ASSERT_EQ(loads.at(0).size(), problem.vehicle.wheels.size());
  for (const double load_n : loads[0]) EXPECT_TRUE(std::isnan(load_n));
}

}  // namespace
}  // namespace regoplan
