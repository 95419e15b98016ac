#include "planner/ompl/state_cost.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planner/driving/replay.h"
#include "planner/search/search_processes.h"
#include "tests/planner/planner_run.h"

namespace regoplan {
namespace {

namespace ob = ompl::base;

PlanningProblem around_a_rock() {
  return lrv_problem(one_soil_map(50, firm_regolith(), flat, {{25, 25, 3, 2}}));
}

SearchOutcome searched(const World& world, std::uint64_t seed, std::int64_t iterations) {
  SearchOutcome found;
  bool given = false;
  search_in_processes(
      world, 1,
      [&]() -> std::optional<SearchRun> {
        if (std::exchange(given, true)) return std::nullopt;
        return SearchRun{.planner = "StateCost",
                         .guidance = {.seed = seed, .margin_min = 0.05, .improve = true},
                         .time_s = {},
                         .iterations = iterations};
      },
      [&](const SearchRun&, const std::optional<SearchOutcome>& outcome) {
        if (outcome) found = *outcome;
      },
      {});
  return found;
}

std::vector<double> bits_of(const SearchOutcome& outcome) {
  std::vector<double> all{static_cast<double>(outcome.propagations)};
  for (const ControlSegment& c : outcome.controls) {
    all.insert(all.end(), {c.duration_s, c.speed_target_mps, c.curvature_target_1pm});
  }
  return all;
}

double duration_s(const SearchOutcome& outcome) {
  double sum = 0;
  for (const ControlSegment& segment : outcome.controls) sum += segment.duration_s;
  return sum;
}

}  // namespace

TEST(StateCost, EachPathThatItAnnouncesCostsLessAndTheLastIsWhatItReturns) {
  const PlanningProblem problem = around_a_rock();
  const World world(problem, WorldUse::kSearch, 2);
  PlannerRun run(world, "StateCost", true);
  ASSERT_EQ(run.solve(30000), ob::PlannerStatus::EXACT_SOLUTION);
  ASSERT_GT(run.announced_costs.size(), 1u);
  EXPECT_TRUE(std::is_sorted(run.announced_costs.rbegin(), run.announced_costs.rend()));
  EXPECT_NEAR(run.announced_costs.back(), run.duration_s(), 1e-6);
  EXPECT_NEAR(std::stod(run.progress("best cost REAL")), run.duration_s(), 1e-3);
  const Replay driven =
      replay(world, exact_solution(*run.definition), {.coarse_s = world.search_step_s()});
  EXPECT_TRUE(driven.reached_goal);
  EXPECT_FALSE(driven.rejection);
}

TEST(StateCost, DrivesAnyInnerPlannerBelowTheBound) {
  const PlanningProblem problem = around_a_rock();
  const World world(problem, WorldUse::kSearch, 2);
  for (const char* inner : {"RRT", "KPIECE1", "EST", "StableSparse"}) {
    PlannerRun run(world, "StateCost", true);
    run.planner().params().setParam("inner", inner);
    ASSERT_EQ(run.solve(20000), ob::PlannerStatus::EXACT_SOLUTION) << inner;
    EXPECT_GT(run.announced_costs.size(), 1u) << inner;
    EXPECT_TRUE(std::is_sorted(run.announced_costs.rbegin(), run.announced_costs.rend())) << inner;
  }
}

TEST(StateCost, CountsWhatTheWayCosts) {
  PlanningProblem problem = around_a_rock();
  problem.search.objective = {.per_s = 0, .per_m = 1};
  const World world(problem, WorldUse::kSearch, 2);
  PlannerRun run(world, "StateCost", true);
  ASSERT_EQ(run.solve(20000), ob::PlannerStatus::EXACT_SOLUTION);
  const Replay driven =
      replay(world, exact_solution(*run.definition), {.coarse_s = world.search_step_s()}, false);
  EXPECT_NEAR(run.announced_costs.back(), driven.length_m, 1e-6);
}

TEST(StateCost, UnderABoundTheMetricIsThatOfStateCostSpace) {
  const PlanningProblem problem = around_a_rock();
  const World world(problem, WorldUse::kSearch, 2);
  PlannerRun run(world, "RRT");
  run.problem.accept_first_below(30);
  const auto& space = *run.problem.space();
  const ob::StateSamplerPtr sampler = space.allocStateSampler();
  ob::State *a = space.allocState(), *b = space.allocState();
  for (int i = 0; i < 200; ++i) {
    sampler->sampleUniform(a);
    EXPECT_LT(a->as<VehicleSpace::StateType>()->cost, 30);
    space.copyState(b, a);
    EXPECT_EQ(space.distance(a, b), 0);
    b->as<VehicleSpace::StateType>()->cost += 1;
    EXPECT_GT(space.distance(a, b), 0);
    EXPECT_EQ(space.distance(a, b), space.distance(b, a));
  }
  a->as<VehicleSpace::StateType>()->cost = 30;
  EXPECT_FALSE(space.isValid(a));
  for (ob::State* state : {a, b}) space.freeState(state);
}

TEST(StateCost, TheSameSeedGivesTheSamePathAndMoreIterationsNoDearerOne) {
  const PlanningProblem problem = around_a_rock();
  const World world(problem, WorldUse::kSearch, 1);
  const SearchOutcome once = searched(world, 3, 8000);
  ASSERT_FALSE(once.controls.empty());
  EXPECT_EQ(bits_of(once), bits_of(searched(world, 3, 8000)));
  EXPECT_NE(bits_of(once), bits_of(searched(world, 4, 8000)));
  EXPECT_LE(duration_s(searched(world, 3, 24000)), duration_s(once));
}

TEST(StateCost, WhereThereIsNoWayItEndsWithTheBound) {
  const PlanningProblem problem =
      lrv_problem(one_soil_map(50, firm_regolith(), flat, ring_of_rocks(40, 25, 6)));
  const World world(problem, WorldUse::kSearch, 2);
  PlannerRun run(world, "StateCost");
  EXPECT_EQ(run.solve(5000), ob::PlannerStatus::TIMEOUT);
  EXPECT_TRUE(exact_solution(*run.definition).empty());
}

}  // namespace regoplan
