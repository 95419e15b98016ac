#include "planner/driving/steer_back.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/planner/flat_problem.h"

namespace regoplan {
namespace {

constexpr VehicleControl kStraight{.speed_target_mps = 2};

VehicleState driving(double speed_mps) {
  return {.x_m = 20, .y_m = 20, .motion = {.vx_mps = speed_mps}, .rim_speed_mps = speed_mps};
}

PlanningProblem open_ground() {
  return lrv_problem(one_soil_map(200, firm_regolith(), [](double x, double y) {
    return 0.5 * std::sin(x / 5) * std::cos(y / 6);
  }));
}

/// 150 m of slalom.
std::vector<ControlSegment> slalom() {
  std::vector<ControlSegment> controls{
      {.duration_s = 8, .speed_target_mps = 2.5},
      {.duration_s = 3, .speed_target_mps = 2.5, .curvature_target_1pm = -0.06}};
  for (int i = 0; i < 8; ++i) {
    controls.push_back(
        {.duration_s = 6, .speed_target_mps = 2.5, .curvature_target_1pm = i % 2 ? -0.06 : 0.06});
  }
  return controls;
}

}  // namespace

TEST(SteerBack, WhereItShouldBeNothingIsCorrected) {
  const PlanningProblem problem = open_ground();
  VehicleState near = driving(2);
  near.x_m += 0.005;
  const VehicleControl control = steered_back(problem, kStraight, driving(2), near);
  EXPECT_EQ(control.curvature_target_1pm, 0);
  EXPECT_EQ(control.speed_target_mps, 2);
}

TEST(SteerBack, ItSteersTowardTheWayAheadAndInReverse) {
  const PlanningProblem problem = open_ground();
  VehicleState left = driving(2), left_in_reverse = driving(-2);
  left.y_m += 0.3;
  left_in_reverse.y_m += 0.3;
  const VehicleControl ahead = steered_back(problem, kStraight, driving(2), left);
  EXPECT_LT(ahead.curvature_target_1pm, 0);
  const VehicleControl back =
      steered_back(problem, {.speed_target_mps = -2}, driving(-2), left_in_reverse);
  EXPECT_LT(back.curvature_target_1pm, 0);
  VehicleState turned = driving(-2);
  turned.yaw_rad = 0.1;  // backing off to the right: what turns it back is to the left
  EXPECT_GT(
      steered_back(problem, {.speed_target_mps = -2}, driving(-2), turned).curvature_target_1pm, 0);
}

TEST(SteerBack, WhoIsAheadSlowsDownButNeverTurnsRound) {
  const PlanningProblem problem = open_ground();
  VehicleState ahead = driving(2);
  ahead.x_m += 1;
  EXPECT_LT(steered_back(problem, kStraight, driving(2), ahead).speed_target_mps, 2);
  ahead.x_m += 50;
  EXPECT_EQ(steered_back(problem, kStraight, driving(2), ahead).speed_target_mps, 0);
}

TEST(SteerBack, WhatAWeakerSoilCarriesAsideComesBackToTheSearchedPath) {
  const PlanningProblem firm = open_ground();
  UncertainSoil weak_soil = firm_regolith();
  weak_soil.mean.friction_angle_rad -= 6 * kTestDegree;
  PlanningProblem weak = lrv_problem(one_soil_map(
      120, weak_soil, [](double x, double y) { return 0.5 * std::sin(x / 5) * std::cos(y / 6); }));
  const World searched(firm, WorldUse::kSearch, 1), other(weak, WorldUse::kSearch, 1);
  const ReplaySteps steps{.coarse_s = searched.search_step_s(), .fine_per_coarse = 2};
  const Replay wanted = replay(searched, slalom(), {.coarse_s = searched.search_step_s()}, false);
  const std::vector<ControlSegment> corrected = steered_back(other, steps, slalom(), wanted.coarse);
  const double open_loop_m = deviation_max_m(wanted, replay(other, slalom(), steps, false));
  const double closed_loop_m = deviation_max_m(wanted, replay(other, corrected, steps, false));
  EXPECT_GT(open_loop_m, 1);
  EXPECT_LT(closed_loop_m, 0.25 * open_loop_m);
}

}  // namespace regoplan
