#include "planner/certificate/least_length.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "planner/ompl/drive.h"
#include "tests/planner/planner_run.h"

namespace regoplan {
namespace {

/// A wall of rocks across the map at x = 25, open above y = 40.
std::vector<Rock> wall_open_at_the_top() {
  std::vector<Rock> rocks;
  for (double y = 0; y < 40; y += 0.8) rocks.push_back({25, y, 0.6, 3});
  return rocks;
}

/// Length that is left at each step of the searched path, and where; empty where none is found.
std::vector<std::pair<double, VehicleState>> steps_to_goal(const World& world) {
  PlannerRun run(world, "Lattice");
  run.solve(3000);
  std::vector<std::pair<double, VehicleState>> steps;
  VehicleSpace::Values values;
  values.vehicle = world.start();
  double driven_m = 0;
  for (const Drive& drive : drives_of(exact_solution(*run.definition), run.problem.step_s())) {
    for (int i = 0; i < drive.steps; ++i) {
      steps.emplace_back(driven_m, values.vehicle);
      const VehicleState before = values.vehicle;
      values = run.problem.steps().next(values, drive.control, run.problem.step_s()).values;
      driven_m += std::hypot(values.vehicle.x_m - before.x_m, values.vehicle.y_m - before.y_m);
    }
  }
  for (auto& [length_m, state] : steps) length_m = driven_m - length_m;
  return steps;
}

}  // namespace

TEST(LeastLength, OnOpenGroundIsTheStraightOne) {
  const PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat));
  const LeastLength least(problem);
  const Goal& goal = problem.goal;
  for (const double x : {5.0, 12.3, 30.0}) {
    for (const double y : {4.0, 25.0, 41.7}) {
      const double straight_m = std::hypot(x - goal.x_m, y - goal.y_m) - goal.radius_m;
      EXPECT_NEAR(least.to_goal_m(x, y), straight_m, 1e-9);
    }
  }
  EXPECT_EQ(least.to_goal_m(goal.x_m, goal.y_m), 0);
}

TEST(LeastLength, LeadsRoundAWall) {
  const PlanningProblem problem =
      lrv_problem(one_soil_map(50, firm_regolith(), flat, wall_open_at_the_top()));
  const LeastLength least(problem);
  const double up_and_down_m = (40 - 10) + (40 - problem.goal.y_m) - problem.goal.radius_m;
  EXPECT_GT(least.to_goal_m(20, 10), 0.95 * up_and_down_m);
  EXPECT_NEAR(least.to_goal_m(30, problem.goal.y_m),
              std::abs(30 - problem.goal.x_m) - problem.goal.radius_m, 1e-9);
}

TEST(LeastLength, IsInfiniteWhereNoWayLeads) {
  const PlanningProblem problem =
      lrv_problem(one_soil_map(50, firm_regolith(), flat, ring_of_rocks(40, 25, 7)));
  EXPECT_EQ(LeastLength(problem).to_goal_m(10, 25), std::numeric_limits<double>::infinity());
}

TEST(LeastLength, NoPathThatIsDrivenIsShorter) {
  PlanningProblem round =
      lrv_problem(one_soil_map(50, firm_regolith(), flat, wall_open_at_the_top()));
  round.start.y_m = round.goal.y_m = 20;
  int rounded = 0;
  const PlanningProblem between =
      lrv_problem(one_soil_map(50, firm_regolith(), flat, two_rows_of_rocks()));
  for (const PlanningProblem& problem : {round, between}) {
    const World world(problem, WorldUse::kSearch, 2);
    const LeastLength least(problem);
    const auto steps = steps_to_goal(world);
    EXPECT_FALSE(steps.empty());
    for (const auto& [length_m, state] : steps) {
      const double bound_m = least.to_goal_m(state.x_m, state.y_m);
      EXPECT_LE(bound_m, length_m + 1e-9) << state.x_m << ", " << state.y_m;
      const double straight_m =
          std::hypot(state.x_m - problem.goal.x_m, state.y_m - problem.goal.y_m) -
          problem.goal.radius_m;
      rounded += bound_m > straight_m + 1;
    }
  }
  EXPECT_GT(rounded, 10);  // or the straight line is all that was tried
}

}  // namespace regoplan
