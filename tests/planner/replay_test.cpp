#include "planner/driving/replay.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <initializer_list>

#include "planner/driving/stopping.h"
#include "tests/planner/flat_problem.h"

namespace regoplan {
namespace {

/// Straight ahead at 3 m/s, and stopping if asked to.
Replay driven(const PlanningProblem& problem, double at_speed_s, bool brakes) {
  const World verdict(problem, WorldUse::kVerdict, 2);
  std::vector<ControlSegment> controls{{.duration_s = at_speed_s, .speed_target_mps = 2.9}};
  if (brakes) controls.push_back({.duration_s = 12, .speed_target_mps = 0});
  return replay(verdict, controls, verification_steps(verdict));
}

PlanningProblem rolling_toward_the_goal(std::vector<Rock> rocks = {}) {
  PlanningProblem problem = lrv_problem(one_soil_map(60, firm_regolith(), flat, std::move(rocks)));
  problem.start = {.x_m = 10, .y_m = 25, .heading_rad = 0, .speed_mps = 2.9};
  return problem;
}

}  // namespace

TEST(Replay, DeviateByTheLargestDistanceOnTheGroundAtEqualTimes) {
  const auto through = [](std::initializer_list<std::array<double, 2>> places) {
    Replay replay;
    for (const auto& [x_m, y_m] : places) {
      replay.coarse.emplace_back();
      replay.coarse.back().x_m = x_m;
      replay.coarse.back().y_m = y_m;
    }
    return replay;
  };
  const Replay straight = through({{0, 0}, {1, 0}, {2, 0}, {3, 0}});
  EXPECT_DOUBLE_EQ(deviation_max_m(straight, through({{0, 0}, {1, 0.5}, {2, 0.2}})), 0.5);
  EXPECT_DOUBLE_EQ(deviation_max_m(straight, through({{0, 0}, {1.3, -0.4}, {2, 0.2}, {3, 0}})),
                   0.5);
  EXPECT_DOUBLE_EQ(deviation_max_m(straight, straight), 0);
}

TEST(Replay, CrossingTheGoalAtSpeedIsNotReachingIt) {
  const Replay crossed = driven(rolling_toward_the_goal(), 13, false);
  EXPECT_GT(crossed.end.x_m, 45);  // 5 m beyond the centre of a circle of 3 m
  EXPECT_FALSE(crossed.rejection);
  EXPECT_FALSE(crossed.reached_goal);
}

TEST(Replay, GoesOnThroughTheGoalUntilItIsAtRestThere) {
  // 30 m to the centre, 14 m of them braking.
  const Replay stopped = driven(rolling_toward_the_goal(), 5.5, true);
  EXPECT_FALSE(stopped.rejection);
  ASSERT_TRUE(stopped.reached_goal);
  EXPECT_NEAR(stopped.end.rim_speed_mps, 0, 1e-9);
  EXPECT_LE(std::abs(stopped.end.motion.vx_mps), VehicleDynamics::kStandstillSpeed_mps);
  EXPECT_NEAR(stopped.end.x_m, 40, 3);
  EXPECT_GT(stopped.duration_s, 5.5 + 2.9 / 0.3 - 0.2);
}

TEST(Replay, AtTheSpeedThatTheGoalAllowsItEndsAsSoonAsTheCircleIsReached) {
  PlanningProblem problem = rolling_toward_the_goal();
  problem.goal.speed_max_mps = 3;
  const Replay crossed = driven(problem, 13, false);
  EXPECT_FALSE(crossed.rejection);
  EXPECT_TRUE(crossed.reached_goal);
  EXPECT_NEAR(crossed.end.x_m, 37, 0.1);
}

TEST(Replay, WhoCannotStopBehindTheGoalHasNotReachedIt) {
  // The nose stands 1.6 m before the origin; braking takes 14 m from 37 m on.
  PlanningProblem problem = rolling_toward_the_goal({{46, 24, 1, 2}, {46, 26, 1, 2}});
  problem.goal.speed_max_mps = 3;
  const Replay crossed = driven(problem, 13, false);
  ASSERT_TRUE(crossed.rejection);
  EXPECT_EQ(crossed.rejection->reason, Rejection::kObstacle);
  EXPECT_TRUE(crossed.rejection->while_stopping);
  EXPECT_GT(crossed.rejection->x_m, 40);
}

TEST(RefusedStop, IsNoneWhereStraighteningTheWheelsLeadsPastWhatTheTurnWouldHit) {
  const auto refusal = [](std::vector<Rock> rocks) {
    const PlanningProblem problem =
        lrv_problem(one_soil_map(60, firm_regolith(), flat, std::move(rocks)));
    const World verdict(problem, WorldUse::kVerdict, 2);
    const VehicleState turning = verdict.dynamics().rolling_state(25, 25, 0, 1.5, 0.2);
    return refused_stop(verdict, turning, verification_steps(verdict));
  };
  const Rock inside_the_turn{29.6, 28.2, 0.8, 2}, ahead{31, 25.5, 0.8, 2};
  EXPECT_FALSE(refusal({}));
  EXPECT_FALSE(refusal({ahead}) || refusal({inside_the_turn}));  // each way out is enough
  const auto refused = refusal({inside_the_turn, ahead});
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->reason, Rejection::kObstacle);
  EXPECT_TRUE(refused->while_stopping);
}

}  // namespace regoplan
