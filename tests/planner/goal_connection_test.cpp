#include "planner/ompl/goal_connection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planner/driving/replay.h"
#include "tests/planner/planner_run.h"

namespace regoplan {
namespace {

namespace ob = ompl::base;

constexpr double kFar_m = 60;

/// The goal asks for a pose that faces back to where the vehicle comes from.
PlanningProblem facing_back(std::vector<Rock> rocks = {}) {
  PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat, std::move(rocks)));
  problem.goal = {.x_m = 30,
                  .y_m = 25,
                  .radius_m = 1,
                  .heading_rad = std::numbers::pi,
                  .heading_tolerance_rad = 15 * kTestDegree};
  return problem;
}

/// A bay 6 m wide around the goal, closed at its end.
std::vector<Rock> bay() {
  std::vector<Rock> rocks;
  for (double x = 26; x < 35; x += 1.5) {
    rocks.push_back({x, 21, 1, 2});
    rocks.push_back({x, 29, 1, 2});
  }
  for (double y = 21; y <= 29; y += 1.5) rocks.push_back({35, y, 1, 2});
  return rocks;
}

std::vector<GoalConnection::Step> connected(const PlanningProblem& problem, double speed_mps,
                                            double longest_m = kFar_m) {
  const World world(problem, WorldUse::kSearch, 2);
  const PlannerRun run(world, "Lattice");
  VehicleState from = world.start();
  from.rim_speed_mps = from.motion.vx_mps = speed_mps;
  return connection_to_goal(run.problem, from, longest_m).steps;
}

}  // namespace

TEST(GoalConnection, EndsSlowAtTheGoalsPose) {
  for (const double speed : {0.0, 0.8, -0.5}) {
    const std::vector<GoalConnection::Step> steps = connected(facing_back(), speed);
    ASSERT_FALSE(steps.empty());
    const VehicleState& end = steps.back().due;
    EXPECT_NEAR(end.x_m, 30, 0.1);
    EXPECT_NEAR(end.y_m, 25, 0.1);
    EXPECT_NEAR(std::remainder(end.yaw_rad - std::numbers::pi, 2 * std::numbers::pi), 0, 0.02);
    EXPECT_LT(std::abs(end.rim_speed_mps), 0.2);
  }
}

TEST(GoalConnection, NoneThroughARockNoneLongerThanAskedForNoneToAnyHeading) {
  EXPECT_TRUE(connected(facing_back({{20, 25, 3, 2}}), 0).empty());
  EXPECT_TRUE(connected(facing_back(), 0, 5).empty());
  PlanningProblem any = facing_back();
  any.goal.heading_rad.reset();
  EXPECT_TRUE(connected(any, 0).empty());
}

TEST(Lattice, BacksIntoABayThatItMustLeaveForwards) {
  const PlanningProblem problem = facing_back(bay());
  const World world(problem, WorldUse::kSearch, 2);
  PlannerRun run(world, "Lattice");
  ASSERT_EQ(run.solve(40000), ob::PlannerStatus::EXACT_SOLUTION);
  const World verdict(problem, WorldUse::kVerdict, 2);
  const Replay driven =
      replay(verdict, exact_solution(*run.definition), verification_steps(verdict));
  EXPECT_TRUE(driven.reached_goal);
  EXPECT_FALSE(driven.rejection);
  const auto last_moving =
      std::find_if(driven.coarse.rbegin(), driven.coarse.rend(),
                   [](const VehicleState& state) { return state.rim_speed_mps != 0; });
  ASSERT_NE(last_moving, driven.coarse.rend());
  EXPECT_LT(last_moving->rim_speed_mps, 0);
}

}  // namespace regoplan
