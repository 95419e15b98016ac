#include "planner/ompl/arrival.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>

#include "planner/verdict/verified_path.h"
#include "tests/planner/planner_run.h"

namespace regoplan {
namespace {

/// A wall across the map, from south to north.
std::vector<Rock> wall_at(double x_m) {
  std::vector<Rock> rocks;
  for (double y = 1; y < 50; y += 1.5) rocks.push_back({x_m, y, 1, 2});
  return rocks;
}

double speed_mps(const VehicleState& state) {
  return std::hypot(state.motion.vx_mps, state.motion.vy_mps);
}

double away_m(const Goal& goal, const VehicleState& state) {
  return std::hypot(state.x_m - goal.x_m, state.y_m - goal.y_m);
}

/// A problem's worlds, whose tables take longer than most searches.
struct Worlds {
  explicit Worlds(const PlanningProblem& problem)
      : searched(problem, WorldUse::kSearch, 2), verdict(problem, WorldUse::kVerdict, 2) {}
  World searched, verdict;
};

/// What a planner finds, as the verdict drives it; nothing where it finds nothing.
std::optional<VerifiedPath> verified(const Worlds& worlds, const std::string& planner,
                                     unsigned int iterations) {
  PlannerRun run(worlds.searched, planner);
  run.solve(iterations);
  const std::vector<ControlSegment> controls = exact_solution(*run.definition);
  if (controls.empty()) return std::nullopt;
  return verify(worlds.verdict, worlds.searched, {.planner = planner, .controls = controls});
}

testing::AssertionResult passed(const std::optional<VerifiedPath>& path) {
  if (!path) return testing::AssertionFailure() << "none found";
  if (path->candidate.verified.passed) return testing::AssertionSuccess();
  return testing::AssertionFailure() << path->candidate.verified.reason;
}

class ArrivalOf : public testing::TestWithParam<std::string> {};

TEST_P(ArrivalOf, PathEndsAtRestInTheGoalBeforeAWall) {
  // From 3 m/s the vehicle stops in 15 m; the wall stands 7 m behind the goal's centre.
  const PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat, wall_at(47)));
  const std::optional<VerifiedPath> path = verified(Worlds(problem), GetParam(), 20000);
  ASSERT_TRUE(passed(path));
  const VehicleState& end = path->replay.end;
  EXPECT_NEAR(end.rim_speed_mps, 0, 1e-9);
  EXPECT_LE(speed_mps(end), 1e-3);
  EXPECT_LE(away_m(problem.goal, end), problem.goal.radius_m);
}

INSTANTIATE_TEST_SUITE_P(Every, ArrivalOf,
                         testing::Values("Lattice", "StableSparse", "StateCost", "RRT", "KPIECE1",
                                         "EST", "PDST", "SST", "SyclopRRT", "SyclopEST"),
                         [](const auto& planner) { return planner.param; });

TEST(Arrival, AsFastAsTheGoalAllowsWhereTheVehicleCanThenStop) {
  PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat, wall_at(47)));
  problem.goal.speed_max_mps = 1;
  PlanningProblem problem_at_rest = problem;
  problem_at_rest.goal.speed_max_mps = 0;
  const Worlds slowly(problem), at_rest(problem_at_rest);
  for (const char* planner : {"Lattice", "StableSparse", "RRT"}) {
    const std::optional<VerifiedPath> path = verified(slowly, planner, 20000);
    ASSERT_TRUE(passed(path)) << planner;
    const VehicleState& end = path->replay.end;
    EXPECT_LE(speed_mps(end), 1) << planner;
    EXPECT_GT(speed_mps(end), 0.1) << planner;
    EXPECT_LE(away_m(problem.goal, end), problem.goal.radius_m) << planner;
    const std::optional<VerifiedPath> slower = verified(at_rest, planner, 20000);
    ASSERT_TRUE(passed(slower)) << planner;
    EXPECT_LT(path->candidate.duration_s, slower->candidate.duration_s) << planner;
  }
}

TEST(Arrival, AGoalThatCanOnlyBeCrossedAtSpeedHasNoPath) {
  // 3 m/s at the start and 8 m to the wall: 15 m are needed to stop, and nothing else avoids it.
  PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat, wall_at(20)));
  problem.start.speed_mps = 3;
  problem.goal = {.x_m = 15, .y_m = 25, .radius_m = 2, .heading_rad = {}};
  for (const double allowed_mps : {0.0, 3.0}) {
    problem.goal.speed_max_mps = allowed_mps;
    const Worlds worlds(problem);
    for (const char* planner : {"Lattice", "StableSparse", "RRT"}) {
      EXPECT_FALSE(passed(verified(worlds, planner, 3000))) << planner;
    }
  }
}

TEST(Arrival, FromWhereTheVehicleIsTooFastNoneIsTried) {
  const PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat));
  const World world(problem, WorldUse::kSearch, 2);
  SearchSteps steps(world, 0.05, 1);
  const auto at = [&](double x_m, double heading_rad) {
    VehicleSpace::Values values;
    values.vehicle = world.dynamics().rolling_state(x_m, 25, heading_rad, 2.9);
    return values;
  };
  EXPECT_FALSE(arrival_from(steps, at(32, 0), {.hold_max_m = 5}).reached);    // 8 m are too few
  EXPECT_FALSE(arrival_from(steps, at(15, 0), {.hold_max_m = 5}).reached);    // too early
  EXPECT_FALSE(arrival_from(steps, at(25, 3.1), {.hold_max_m = 5}).reached);  // away from it
  EXPECT_EQ(steps.count(), 0);
  EXPECT_TRUE(arrival_from(steps, at(25, 0), {.hold_max_m = 5}).reached);
  EXPECT_GT(steps.count(), 0);
}

TEST(Arrival, ComesToRestInACircleOfHalfAMetreUphillAndDown) {
  for (const double rise : {-0.17, 0.0, 0.17}) {
    PlanningProblem problem = lrv_problem(
        one_soil_map(50, firm_regolith(), [rise](double x, double) { return rise * x; }));
    problem.goal.radius_m = 0.5;
    const std::optional<VerifiedPath> path = verified(Worlds(problem), "Lattice", 20000);
    ASSERT_TRUE(passed(path)) << rise;
    EXPECT_LE(away_m(problem.goal, path->replay.end), 0.5) << rise;
  }
}

}  // namespace
}  // namespace regoplan
