// What of OMPL would go wrong unnoticed, each held by a law.
#include "planner/ompl/ompl_problem.h"

#include <gtest/gtest.h>
#include <ompl/base/OptimizationObjective.h>
#include <ompl/base/goals/GoalSampleableRegion.h>

#include "planner/ompl/map_decomposition.h"
#include "planner/ompl/vehicle_space.h"
#include "tests/planner/planner_run.h"

namespace regoplan {
namespace {

namespace ob = ompl::base;

/// A problem posed on open ground.
struct Posed {
  PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat));
  World world{problem, WorldUse::kSearch, 2};
};

}  // namespace

TEST(OmplProblem, TheMetricIsSymmetricAndHoldsTheTriangleInequality) {
  const Posed posed;
  const PlannerRun run(posed.world, "RRT");
  const auto& space = *run.problem.space();
  const ob::StateSamplerPtr sampler = space.allocStateSampler();
  ob::State *a = space.allocState(), *b = space.allocState(), *c = space.allocState();
  for (int i = 0; i < 500; ++i) {
    for (ob::State* state : {a, b, c}) sampler->sampleUniform(state);
    EXPECT_EQ(space.distance(a, b), space.distance(b, a));
    EXPECT_LE(space.distance(a, c), space.distance(a, b) + space.distance(b, c) + 1e-9);
  }
  for (ob::State* state : {a, b, c}) space.freeState(state);
}

TEST(OmplProblem, AProjectionIsRegistered) {
  const Posed posed;
  const PlannerRun run(posed.world, "RRT");
  ASSERT_TRUE(run.problem.space()->getStateSpace()->hasDefaultProjection());
  EXPECT_EQ(run.problem.space()->getStateSpace()->getDefaultProjection()->getDimension(), 2u);
}

TEST(OmplProblem, GoalsThatAreDrawnAreGoalsThatMayBe) {
  Posed posed;
  const PlannerRun run(posed.world, "RRT");
  const auto& goal = *run.definition->getGoal()->as<ob::GoalSampleableRegion>();
  ob::State* state = run.problem.space()->allocState();
  for (int i = 0; i < 100; ++i) {
    goal.sampleGoal(state);
    EXPECT_TRUE(goal.isSatisfied(state));
    EXPECT_TRUE(run.problem.space()->isValid(state));
  }
  run.problem.space()->freeState(state);
}

TEST(OmplProblem, ThePathThatComesCloseIsNoSolution) {
  const PlanningProblem problem =
      lrv_problem(one_soil_map(50, firm_regolith(), flat, ring_of_rocks(40, 25, 7)));
  const World world(problem, WorldUse::kSearch, 2);
  PlannerRun run(world, "RRT");
  const ob::PlannerStatus status = run.solve(200);
  EXPECT_TRUE(status == ob::PlannerStatus::APPROXIMATE_SOLUTION);
  EXPECT_TRUE(run.definition->hasSolution());  // which OMPL says of it all the same
  EXPECT_TRUE(exact_solution(*run.definition).empty());
}

TEST(OmplProblem, SstStopsAtItsFirstPathUnlessItIsToImprove) {
  const Posed posed;
  const auto threshold = [&](bool improve) {
    const PlannerRun run(posed.world, "SST", improve);
    return run.definition->getOptimizationObjective()->getCostThreshold().value();
  };
  EXPECT_EQ(threshold(true), 0);
  EXPECT_EQ(threshold(false), std::numeric_limits<double>::max());
}

TEST(OmplProblem, SstLeavesItsStartHoweverLargeTheMap) {
  PlanningProblem problem = lrv_problem(one_soil_map(300, firm_regolith(), flat));
  const World world(problem, WorldUse::kSearch, 2);
  PlannerRun run(world, "SST");
  EXPECT_EQ(run.solve(20000), ob::PlannerStatus::EXACT_SOLUTION);
}

TEST(OmplProblem, TheSeedIsThatOfOmplsOwnPlannersToo) {
  const Posed posed;
  const auto found = [&](std::uint64_t seed) {
    PlannerRun run(posed.world, "RRT", false, seed);
    run.solve(20000);
    return std::pair(run.problem.propagations(), run.duration_s());
  };
  const auto first = found(1);
  EXPECT_GT(first.second, 0);
  EXPECT_NE(found(2), first);
  EXPECT_EQ(found(1), first);
}

TEST(OmplProblem, AStateOnceCountedIsCountedOnce) {
  const Posed posed;
  PlannerRun run(posed.world, "StableSparse");
  run.solve(500);
  const std::int64_t steps = run.problem.propagations();
  EXPECT_GT(steps, 0);
  (void)exact_solution(*run.definition);  // which drives nothing again
  EXPECT_EQ(run.problem.propagations(), steps);
}

class Syclop : public testing::TestWithParam<const char*> {};

TEST_P(Syclop, IsLedAfterClearAsBefore) {
  const PlanningProblem problem =
      lrv_problem(one_soil_map(50, firm_regolith(), flat, {{25, 25, 3, 2}}));
  const World world(problem, WorldUse::kSearch, 2);
  PlannerRun run(world, GetParam());
  for (int i = 0; i < 2; ++i) {
    run.planner().clear();
    run.definition->clearSolutionPaths();
    run.solve(100000);
    EXPECT_FALSE(exact_solution(*run.definition).empty()) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Both, Syclop, testing::Values("SyclopRRT", "SyclopEST"),
                         [](const auto& planner) { return std::string(planner.param); });

}  // namespace regoplan
