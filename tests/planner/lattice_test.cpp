#include "planner/ompl/lattice.h"

#include <gtest/gtest.h>

#include <cmath>

#include "planner/driving/replay.h"
#include "planner/ompl/path_improvement.h"
#include "tests/planner/planner_run.h"

namespace regoplan {
namespace {

namespace ob = ompl::base;

std::vector<double> bits_of(const std::vector<ControlSegment>& controls) {
  std::vector<double> all;
  for (const ControlSegment& c : controls) {
    all.insert(all.end(), {c.duration_s, c.speed_target_mps, c.curvature_target_1pm});
  }
  return all;
}

}  // namespace

TEST(Lattice, AFewThousandStepsLeadThroughStaggeredGaps) {
  const PlanningProblem problem =
      lrv_problem(one_soil_map(50, firm_regolith(), flat, two_rows_of_rocks()));
  const World world(problem, WorldUse::kSearch, 2);
  PlannerRun run(world, "Lattice");
  ASSERT_EQ(run.solve(20000), ob::PlannerStatus::EXACT_SOLUTION);
  EXPECT_LT(run.problem.propagations(), 60000);
  const World verdict(problem, WorldUse::kVerdict, 2);
  const Replay driven =
      replay(verdict, exact_solution(*run.definition), verification_steps(verdict));
  EXPECT_TRUE(driven.reached_goal);
  EXPECT_FALSE(driven.rejection);
}

TEST(Lattice, AnAlleyNarrowerThanTheVehicleAtFullLockIsDrivenThrough) {
  // 2.5 m wide and 10 m long, off the straight way; at full lock the wheels span 2.6 m.
  std::vector<Rock> rocks;
  for (const double side : {-1.0, 1.0}) {
    const double edge_m = 27.3 + side * (1.25 + 0.5);
    for (double x = 20; x <= 30; x += 0.8) rocks.push_back({x, edge_m, 0.5, 1.5});
    for (double away = 0.8; away <= 40; away += 0.8) {
      rocks.push_back({20, edge_m + side * away, 0.5, 1.5});
    }
  }
  const PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat, rocks));
  const World world(problem, WorldUse::kSearch, 2);
  PlannerRun run(world, "Lattice");
  ASSERT_EQ(run.solve(50000), ob::PlannerStatus::EXACT_SOLUTION);
  const World verdict(problem, WorldUse::kVerdict, 2);
  const Replay driven =
      replay(verdict, exact_solution(*run.definition), verification_steps(verdict));
  EXPECT_TRUE(driven.reached_goal);
  EXPECT_FALSE(driven.rejection);
}

TEST(Lattice, AllowingMoreSpeedThanTurnsBearTakesNoWayAway) {
  PlanningProblem problem =
      lrv_problem(one_soil_map(50, firm_regolith(), flat, two_rows_of_rocks()));
  problem.speed_max_mps = 10;
  const World world(problem, WorldUse::kSearch, 2);
  PlannerRun run(world, "Lattice");
  EXPECT_EQ(run.solve(20000), ob::PlannerStatus::EXACT_SOLUTION);
}

TEST(Lattice, WhatItFindsIsWhatTheDynamicsDo) {
  const PlanningProblem problem = lrv_problem(one_soil_map(
      50, firm_regolith(), [](double x, double y) { return 0.5 * std::sin(x / 5 + y / 7); }));
  const World world(problem, WorldUse::kSearch, 2);
  PlannerRun run(world, "Lattice");
  ASSERT_EQ(run.solve(20000), ob::PlannerStatus::EXACT_SOLUTION);
  const std::vector<ControlSegment> controls = exact_solution(*run.definition);
  // The same steps again, every state judged: nothing in the path is approximate.
  const Replay driven = replay(world, controls, {.coarse_s = world.search_step_s()});
  EXPECT_TRUE(driven.reached_goal);
  EXPECT_FALSE(driven.rejection);
  EXPECT_NEAR(driven.duration_s, run.duration_s(), 1e-9);
}

TEST(Lattice, DrawsNothingAndRepeatsItself) {
  const PlanningProblem problem =
      lrv_problem(one_soil_map(50, firm_regolith(), flat, two_rows_of_rocks()));
  const World world(problem, WorldUse::kSearch, 2);
  PlannerRun one(world, "Lattice", false, 1), other(world, "Lattice", false, 99);
  one.solve(20000);
  other.solve(20000);
  EXPECT_EQ(bits_of(exact_solution(*one.definition)), bits_of(exact_solution(*other.definition)));

  other.planner().clear();
  other.definition->clearSolutionPaths();
  other.solve(20000);
  EXPECT_EQ(bits_of(exact_solution(*one.definition)), bits_of(exact_solution(*other.definition)));
}

TEST(Lattice, EachPathThatItAnnouncesIsCheaperThanTheLast) {
  const PlanningProblem problem =
      lrv_problem(one_soil_map(50, firm_regolith(), flat, two_rows_of_rocks()));
  const World world(problem, WorldUse::kSearch, 2);
  PlannerRun first(world, "Lattice"), better(world, "Lattice", true);
  first.solve(20000);
  better.solve(20000);
  ASSERT_GT(better.announced_costs.size(), 1u);
  for (std::size_t i = 1; i < better.announced_costs.size(); ++i) {
    EXPECT_LT(better.announced_costs[i], better.announced_costs[i - 1]);
  }
  EXPECT_GT(better.announced_states, 2u);
  EXPECT_LT(better.duration_s(), first.duration_s());
  // The cost is time unless the problem asks for another.
  EXPECT_NEAR(better.announced_costs.back(), better.duration_s(), 1e-6);
  EXPECT_NEAR(std::stod(better.progress("best cost REAL")), better.duration_s(), 1e-5);
}

TEST(Lattice, GoingOnCostsNoMoreThanOptimisingItsFirstPath) {
  const PlanningProblem problem =
      lrv_problem(one_soil_map(50, firm_regolith(), flat, two_rows_of_rocks()));
  const World world(problem, WorldUse::kSearch, 2);
  PlannerRun first(world, "Lattice"), patient(world, "Lattice", true);
  first.solve(20000);
  patient.solve(20000);
  SearchSteps steps(world, problem.limits.margin_min, 0);
  const auto optimised = improved(steps, exact_solution(*first.definition));
  ASSERT_TRUE(optimised);
  EXPECT_LE(patient.duration_s(), optimised->improvement.cost_after + 1e-9);
  EXPECT_LT(patient.duration_s(), first.duration_s());
  // What it counts holds the steps that optimising took.
  EXPECT_GT(patient.problem.propagations(), first.problem.propagations() + steps.count());
}

TEST(Lattice, AFieldThatIsDearerThanTheWayEndsNoSearchForCheaperPaths) {
  const PlanningProblem problem =
      lrv_problem(one_soil_map(50, firm_regolith(), flat, two_rows_of_rocks()));
  const World world(problem, WorldUse::kSearch, 2);
  constexpr double kDearer = 20;  // times, at most: no bound on what the way costs
  PlannerRun plain(world, "Lattice", true), varied(world, "Lattice", true, 1, kDearer);
  plain.solve(20000);
  varied.solve(20000);
  EXPECT_GT(2 * varied.problem.propagations(), plain.problem.propagations());
}

TEST(Lattice, TheGoalCountsWhereverAMotionPassesIt) {
  PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat));
  problem.goal.radius_m = 0.3;  // far less than a drive is long
  const World world(problem, WorldUse::kSearch, 2);
  PlannerRun run(world, "Lattice");
  ASSERT_EQ(run.solve(100000), ob::PlannerStatus::EXACT_SOLUTION);
  const Replay driven =
      replay(world, exact_solution(*run.definition), {.coarse_s = world.search_step_s()}, false);
  EXPECT_TRUE(driven.reached_goal);
}

TEST(Lattice, ArrivesWithTheHeadingThatIsAskedFor) {
  PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat));
  problem.goal.heading_rad = std::numbers::pi;  // back toward the start
  problem.goal.heading_tolerance_rad = 15 * kTestDegree;
  const World world(problem, WorldUse::kSearch, 2);
  PlannerRun run(world, "Lattice");
  ASSERT_EQ(run.solve(100000), ob::PlannerStatus::EXACT_SOLUTION);
  const Replay driven =
      replay(world, exact_solution(*run.definition), {.coarse_s = world.search_step_s()}, false);
  EXPECT_LE(std::abs(std::remainder(driven.end.yaw_rad - std::numbers::pi, 2 * std::numbers::pi)),
            problem.goal.heading_tolerance_rad);
}

TEST(Lattice, BacksOutWhereThereIsNoWayForward) {
  // A pocket: rocks ahead and to both sides, the goal behind.
  std::vector<Rock> rocks;
  for (double y = 19; y <= 31; y += 1.2) rocks.push_back({29, y, 0.7, 2});
  for (double x = 18; x <= 29; x += 1.2) {
    rocks.push_back({x, 21.5, 0.7, 2});
    rocks.push_back({x, 28.5, 0.7, 2});
  }
  PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat, rocks));
  problem.start = {.x_m = 25, .y_m = 25};
  problem.goal = {.x_m = 10, .y_m = 25, .radius_m = 2, .heading_rad = {}};
  problem.speed_max_mps = 1;
  const World world(problem, WorldUse::kSearch, 2);
  PlannerRun run(world, "Lattice");
  ASSERT_EQ(run.solve(100000), ob::PlannerStatus::EXACT_SOLUTION);
  bool reversed = false;
  for (const ControlSegment& c : exact_solution(*run.definition))
    reversed |= c.speed_target_mps < 0;
  EXPECT_TRUE(reversed);
}

TEST(Lattice, WithoutAWayItEndsWithoutAPath) {
  const PlanningProblem problem =
      lrv_problem(one_soil_map(50, firm_regolith(), flat, ring_of_rocks(40, 25, 7)));
  const World world(problem, WorldUse::kSearch, 2);
  PlannerRun run(world, "Lattice");
  const ob::PlannerStatus status = run.solve(5000);
  EXPECT_EQ(status, ob::PlannerStatus::TIMEOUT);
  EXPECT_FALSE(run.definition->hasSolution());
  EXPECT_TRUE(exact_solution(*run.definition).empty());
}

TEST(Lattice, TheObjectiveDecidesWhatIsCheap) {
  PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat, {{25, 25, 3, 2}}));
  const auto driven_with = [&](const Objective& objective) {
    problem.search.objective = objective;
    const World world(problem, WorldUse::kSearch, 2);
    PlannerRun run(world, "Lattice", true);
    run.solve(8000);
    return replay(world, exact_solution(*run.definition), {.coarse_s = world.search_step_s()});
  };
  const Replay fast = driven_with({.per_s = 1});
  const Replay frugal = driven_with({.per_s = 0.01, .per_j = 1});
  ASSERT_TRUE(fast.reached_goal && frugal.reached_goal);
  EXPECT_LT(fast.duration_s, frugal.duration_s);
  EXPECT_LT(frugal.energy_j, fast.energy_j);
}

}  // namespace regoplan
