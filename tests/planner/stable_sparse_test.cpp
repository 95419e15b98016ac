#include "planner/ompl/stable_sparse.h"

#include <gtest/gtest.h>

#include "planner/driving/replay.h"
#include "tests/planner/planner_run.h"

namespace regoplan {
namespace {

namespace ob = ompl::base;

}  // namespace

TEST(StableSparse, ActiveNodesNeverOutnumberTheWitnesses) {
  const PlanningProblem problem =
      lrv_problem(one_soil_map(50, firm_regolith(), flat, two_rows_of_rocks()));
  const World world(problem, WorldUse::kSearch, 2);
  PlannerRun run(world, "StableSparse", true);
  for (int i = 0; i < 4; ++i) {
    run.solve(3000);
    const SparseTree& tree = run.planner_as<StableSparse>().tree();
    EXPECT_LE(tree.active(), tree.witnesses());
    EXPECT_EQ(run.progress("nodes INTEGER"), std::to_string(tree.active()));
  }
}

TEST(StableSparse, WhatItKeepsIsTheCheapestOfItsWitnessAndWhatItPrunesIsGivenBack) {
  const PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat));
  SparseTree tree(problem);
  const VehicleSpace::Values root{.vehicle = {.x_m = 10, .y_m = 10}};
  const VehicleSpace::Values there{.vehicle = {.x_m = 20.1, .y_m = 10.1}};
  VehicleSpace::Values beside = there;
  beside.vehicle.x_m += 0.1;  // the same witness
  tree.plant(root);
  const int first = tree.grow({.values = there, .cost = 5, .parent = 0});
  EXPECT_FALSE(tree.welcome(beside.vehicle, 6));
  ASSERT_TRUE(tree.welcome(beside.vehicle, 4));
  const std::size_t room = tree.nodes().size();
  tree.grow({.values = beside, .cost = 4, .parent = 0});
  EXPECT_EQ(tree.active(), 2u);
  EXPECT_EQ(tree.inactive(), 0u);  // a leaf goes at once
  // The place of the pruned node is used again.
  VehicleSpace::Values far = there;
  far.vehicle.x_m = 40;
  EXPECT_EQ(tree.grow({.values = far, .cost = 9, .parent = 0}), first);
  EXPECT_EQ(tree.nodes().size(), room + 1);
}

/// A slow drive does not stand for a fast one at the same place: from there they lead elsewhere.
TEST(StableSparse, WitnessesTellSpeedsApart) {
  const PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat));
  SparseTree tree(problem);
  const auto at_speed = [&](double share) {
    VehicleSpace::Values values{.vehicle = {.x_m = 20.1, .y_m = 10.1}};
    values.vehicle.motion.vx_mps = share * problem.speed_max_mps;
    return values;
  };
  tree.plant({.vehicle = {.x_m = 10, .y_m = 10}});
  tree.grow({.values = at_speed(0.1), .cost = 5, .parent = 0});
  EXPECT_FALSE(tree.welcome(at_speed(0.2).vehicle, 6));
  EXPECT_TRUE(tree.welcome(at_speed(0.5).vehicle, 6));
  EXPECT_TRUE(tree.welcome(at_speed(0.9).vehicle, 6));
  EXPECT_TRUE(tree.welcome(at_speed(-0.2).vehicle, 6));
}

TEST(StableSparse, ANodeStaysWhileWhatDescendsFromItCounts) {
  const PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat));
  SparseTree tree(problem);
  const auto at = [](double x) { return VehicleSpace::Values{.vehicle = {.x_m = x, .y_m = 10}}; };
  tree.plant(at(5));
  const int middle = tree.grow({.values = at(15), .cost = 5, .parent = 0});
  const int leaf = tree.grow({.values = at(25), .cost = 9, .parent = middle});
  tree.grow({.values = at(15.1), .cost = 4, .parent = 0});
  EXPECT_EQ(tree.inactive(), 1u);
  EXPECT_EQ(drives_to(tree.nodes(), leaf).size(), 2u);
  tree.prune([](double cost, const VehicleState&) { return cost > 8; });
  EXPECT_EQ(tree.inactive(), 0u);  // with its last descendant it goes too
  EXPECT_EQ(tree.active(), 2u);
}

TEST(StableSparse, ItsCostIsThatOfTheWholePath) {
  const PlanningProblem problem =
      lrv_problem(one_soil_map(50, firm_regolith(), flat, {{25, 25, 3, 2}}));
  const World world(problem, WorldUse::kSearch, 2);
  PlannerRun run(world, "StableSparse", true);
  ASSERT_EQ(run.solve(6000), ob::PlannerStatus::EXACT_SOLUTION);
  ASSERT_FALSE(run.announced_costs.empty());
  EXPECT_NEAR(run.announced_costs.back(), run.duration_s(), 1e-6);
  const Replay driven =
      replay(world, exact_solution(*run.definition), {.coarse_s = world.search_step_s()});
  EXPECT_TRUE(driven.reached_goal);
  EXPECT_FALSE(driven.rejection);
}

TEST(StableSparse, TheSameSeedGivesTheSamePathWhateverElseDrewBefore) {
  const PlanningProblem problem =
      lrv_problem(one_soil_map(50, firm_regolith(), flat, {{25, 25, 3, 2}}));
  const World world(problem, WorldUse::kSearch, 2);
  const auto targets = [&](std::uint64_t seed) {
    PlannerRun run(world, "StableSparse", true, seed);
    run.solve(3000);
    std::vector<double> all;
    for (const ControlSegment& control : exact_solution(*run.definition)) {
      all.insert(all.end(), {control.duration_s, control.curvature_target_1pm});
    }
    return all;
  };
  const std::vector<double> once = targets(3);
  EXPECT_EQ(once, targets(3));
  EXPECT_NE(once, targets(4));
}

TEST(StableSparse, MoreTimeNeverCostsMore) {
  const PlanningProblem problem =
      lrv_problem(one_soil_map(50, firm_regolith(), flat, {{25, 25, 3, 2}}));
  const World world(problem, WorldUse::kSearch, 2);
  PlannerRun brief(world, "StableSparse", true), patient(world, "StableSparse", true);
  brief.solve(1200);
  patient.solve(12000);
  EXPECT_LT(patient.duration_s(), brief.duration_s());
}

}  // namespace regoplan
