#include "planner/certificate/least_duration.h"

#include <gtest/gtest.h>

#include "planner/certificate/least_length.h"
#include "planner/plan.h"
#include "tests/planner/flat_problem.h"

namespace regoplan {
namespace {

TEST(FastestDrive, SpeedsUpHoldsAndSlowsDown) {
  // 0 to 3 m/s at .5 m/s2: 6 s and 9 m; the same at the end; 42 m between at 3 m/s.
  const FastestDrive drive{.speed_max_mps = 3, .acceleration_mps2 = 0.5};
  EXPECT_NEAR(drive.duration_s(60), 6 + 14 + 6, 1e-12);
  // Too short for the top speed: half of the way up, half down.
  EXPECT_NEAR(drive.duration_s(2), 2 * 2.0, 1e-12);
}

TEST(FastestDrive, AtItsSpeedFromTheStartItLosesNothing) {
  const FastestDrive drive{
      .speed_max_mps = 2, .acceleration_mps2 = 1, .start_mps = 2, .end_mps = 2};
  EXPECT_NEAR(drive.duration_s(10), 5, 1e-12);
}

TEST(LeastDuration, AllowsForAVehicleThatRollsFasterThanItsRims) {
  // Braked wheels may slip by slip_max: the vehicle then gains or loses speed faster than its rims.
  PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat));
  const double length_m = LeastLength(problem).to_goal_m(problem.start.x_m, problem.start.y_m);
  for (const double slip_max : {0.0, 0.3, 0.6}) {
    problem.limits.slip_max = slip_max;
    const double faster = 1 / (1 - slip_max);
    const FastestDrive drive{.speed_max_mps = 1.001 * problem.speed_max_mps,
                             .acceleration_mps2 = faster * problem.vehicle.acceleration_max_mps2,
                             .end_mps = faster * VehicleDynamics::kStandstillSpeed_mps};
    EXPECT_NEAR(least_duration_s(problem), drive.duration_s(length_m), 1e-9) << slip_max;
  }
}

TEST(LeastDuration, NoVerifiedPathIsFaster) {
  for (const double rock_radius_m : {0.0, 3.0}) {
    std::vector<Rock> rocks;
    if (rock_radius_m > 0) rocks.push_back({25, 25, rock_radius_m, 2});
    PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat, rocks));
    problem.search.planner = "Lattice";
    problem.search.candidates = 2;
    const PlanResult result = plan(problem);
    ASSERT_EQ(result.status, PlanStatus::kFeasible) << result.reason;
    ASSERT_TRUE(result.least_duration_s);
    EXPECT_GT(*result.least_duration_s, (30 - problem.goal.radius_m) / problem.speed_max_mps);
    for (const Candidate& candidate : result.candidates) {
      EXPECT_GE(candidate.duration_s, *result.least_duration_s);
    }
    EXPECT_GE(*duration_gap(result), 0);
    EXPECT_LT(*duration_gap(result), 0.5);
  }
}

}  // namespace
}  // namespace regoplan
