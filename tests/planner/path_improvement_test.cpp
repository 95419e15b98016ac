#include "planner/ompl/path_improvement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planner/course/path_smoothing.h"
#include "planner/driving/replay.h"
#include "planner/plan.h"
#include "planner/search/search_processes.h"
#include "tests/planner/planner_run.h"

namespace regoplan {
namespace {

std::vector<double> bits_of(const std::vector<ControlSegment>& controls) {
  std::vector<double> all;
  for (const ControlSegment& c : controls) {
    all.insert(all.end(), {c.duration_s, c.speed_target_mps, c.curvature_target_1pm});
  }
  return all;
}

/// Paths of trees that care nothing for costs, over ground with rocks and waves.
struct Found {
  PlanningProblem problem;
  World world{problem, WorldUse::kSearch, 2};
  std::vector<std::vector<ControlSegment>> paths;

  explicit Found(Objective objective = {})
      : problem(lrv_problem(one_soil_map(
            100, firm_regolith(), [](double x, double y) { return 0.2 * std::sin(x / 5 + y / 7); },
            {{40, 34, 2, 2}, {48, 48, 2, 2}, {63, 50, 1.5, 2}}))) {
    problem.goal = {.x_m = 85, .y_m = 70, .radius_m = 3, .heading_rad = {}};
    problem.search.objective = objective;
    std::vector<SearchRun> runs;
    for (const char* planner : {"RRT", "KPIECE1"}) {
      for (const std::uint64_t seed : {1, 2, 3}) {
        runs.push_back({.planner = planner,
                        .guidance = {.seed = seed, .margin_min = 0.05},
                        .time_s = {},
                        .iterations = 4000});
      }
    }
    std::size_t next = 0;
    search_in_processes(
        world, 2, [&] { return next < runs.size() ? std::optional(runs[next++]) : std::nullopt; },
        [&](const SearchRun&, const std::optional<SearchOutcome>& outcome) {
          if (outcome && !outcome->controls.empty()) paths.push_back(outcome->controls);
        },
        {});
  }
};

double smallest_margin(const Replay& driven) {
  double smallest = 1;
  for (const TrajectoryPoint& point : driven.points) smallest = std::min(smallest, point.margin);
  return smallest;
}

}  // namespace

TEST(PathImprovement, NothingWorseAndNothingInvalidComesBack) {
  for (const Objective& objective :
       {Objective{}, Objective{.per_s = 0, .per_m = 1}, Objective{.per_s = 0, .per_j = 1}}) {
    const Found found(objective);
    ASSERT_GE(found.paths.size(), 3u);
    int improvements = 0;
    for (const std::vector<ControlSegment>& path : found.paths) {
      const auto better = improved(found.world, path);
      if (!better) continue;
      ++improvements;
      EXPECT_LT(better->improvement.cost_after, better->improvement.cost_before);
      const ReplaySteps steps{.coarse_s = found.world.search_step_s()};
      const Replay before = replay(found.world, path, steps);
      const Replay after = replay(found.world, better->controls, steps);
      EXPECT_TRUE(after.reached_goal);
      EXPECT_FALSE(after.rejection);
      EXPECT_GE(smallest_margin(after), smallest_margin(before) - 1e-9);
      if (objective.per_s > 0) {
        EXPECT_LT(after.duration_s, before.duration_s);
      }
      if (objective.per_m > 0) {
        EXPECT_LT(after.length_m, before.length_m);
      }
      if (objective.per_j > 0) {
        EXPECT_LT(after.energy_j, before.energy_j);
      }
    }
    EXPECT_GT(improvements, 0);
  }
}

TEST(PathImprovement, ArrivesWhereTheVehicleFallsBehindItsWheels) {
  // Uphill, wheels slip all the way.
  PlanningProblem problem = lrv_problem(
      one_soil_map(150, firm_regolith(), [](double x, double /*y*/) { return 0.2 * x; }));
  problem.goal = {.x_m = 140, .y_m = 40, .radius_m = 2, .heading_rad = {}};
  const World world(problem, WorldUse::kSearch, 2);
  PlannerRun run(world, "Lattice");
  ASSERT_EQ(run.solve(20000), ompl::base::PlannerStatus::EXACT_SOLUTION);
  const auto better = improved(world, exact_solution(*run.definition));
  ASSERT_TRUE(better);
  EXPECT_TRUE(replay(world, better->controls, {.coarse_s = world.search_step_s()}).reached_goal);
}

TEST(PathImprovement, TheSamePathGivesTheSameBits) {
  const Found found;
  int improvements = 0;
  for (const std::vector<ControlSegment>& path : found.paths) {
    const auto once = improved(found.world, path), again = improved(found.world, path);
    ASSERT_EQ(once.has_value(), again.has_value());
    if (!once) continue;
    ++improvements;
    EXPECT_EQ(bits_of(once->controls), bits_of(again->controls));
  }
  EXPECT_GT(improvements, 0);
}

TEST(PathImprovement, APathThatDoesNotReachTheGoalOrBacksUpIsLeftAlone) {
  const Found found;
  EXPECT_FALSE(improved(found.world, {{.duration_s = 4, .speed_target_mps = 1}}));
  EXPECT_FALSE(improved(found.world, {{.duration_s = 4, .speed_target_mps = -1}}));
  EXPECT_FALSE(improved(found.world, {}));
}

TEST(PathSmoothing, AWindingWayBetweenWallsComesStraight) {
  // Walls 8 m either side; the way swings 4 m and back, sharper than it may.
  std::vector<Rock> walls;
  for (double x = 5; x < 95; x += 2.5) {
    walls.push_back({x, 42, 1.5, 2});
    walls.push_back({x, 58, 1.5, 2});
  }
  PlanningProblem problem = lrv_problem(one_soil_map(100, firm_regolith(), flat, std::move(walls)));
  problem.goal = {.x_m = 90, .y_m = 50, .radius_m = 3, .heading_rad = {}};
  std::vector<PathPoint> knots;
  for (double x = 10; x <= 90; x += 2) knots.push_back({x, 52 - 2 * std::cos((x - 10) / 5)});
  for (const PathPoint& point : smoothed(problem, knots, 0.05)) EXPECT_NEAR(point.y_m, 50, 2);
}

TEST(PathSmoothing, AZigzagComesStraighterAndOffTheRocks) {
  const PlanningProblem problem =
      lrv_problem(one_soil_map(50, firm_regolith(), flat, {{25, 25, 2, 2}}));
  std::vector<PathPoint> zigzag;
  for (int i = 0; i <= 12; ++i) {
    zigzag.push_back({10 + 2.5 * i, i < 2 || i > 10 ? 25 : 29 + (i % 2 == 0 ? 0.5 : -0.5)});
  }
  const std::vector<PathPoint> smooth = smoothed(problem, zigzag, 0.1);
  ASSERT_EQ(smooth.size(), zigzag.size());
  const auto length = [](const std::vector<PathPoint>& points) {
    double sum = 0;
    for (std::size_t i = 1; i < points.size(); ++i) {
      sum += std::hypot(points[i].x_m - points[i - 1].x_m, points[i].y_m - points[i - 1].y_m);
    }
    return sum;
  };
  EXPECT_LT(length(smooth), length(zigzag));
  for (int i : {0, 1}) {
    EXPECT_EQ(smooth[static_cast<std::size_t>(i)].x_m, zigzag[static_cast<std::size_t>(i)].x_m);
  }
  for (const PathPoint& point : smooth) {
    EXPECT_GT(std::hypot(point.x_m - 25, point.y_m - 25), 2 + 1.03);
  }
}

TEST(Plan, CandidatesThatWereImprovedSayByHowMuchAndStillPass) {
  PlanningProblem problem = Found().problem;
  problem.search.planner = "RRT";
  problem.search.iterations = 4000;
  problem.search.candidates = 3;
  const auto planned = [&](bool improve) {
    problem.search.improve = improve;
    return plan(problem);
  };
  const PlanResult plain = planned(false), better = planned(true);
  ASSERT_EQ(better.status, PlanStatus::kFeasible) << better.reason;
  int improvements = 0;
  for (const Candidate& candidate : better.candidates) {
    EXPECT_TRUE(candidate.verified.passed);
    if (!candidate.improvement) continue;
    ++improvements;
    const auto before =
        std::find_if(plain.candidates.begin(), plain.candidates.end(),
                     [&](const Candidate& other) { return other.seed == candidate.seed; });
    ASSERT_NE(before, plain.candidates.end());
    EXPECT_FALSE(before->improvement);
    EXPECT_LT(candidate.duration_s, before->duration_s);
    EXPECT_GE(candidate.margin_min, before->margin_min);
  }
  EXPECT_GT(improvements, 0);
}

}  // namespace regoplan
