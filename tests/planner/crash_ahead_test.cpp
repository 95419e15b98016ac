#include "planner/driving/crash_ahead.h"

#include <gtest/gtest.h>

#include "tests/planner/flat_problem.h"

namespace regoplan {
namespace {

/// At 3 m/s, so far before a long wall of rocks.
PlanningProblem before_a_wall(double free_m) {
  std::vector<Rock> wall;
  const double nose_m = 10 + preset_vehicle("lrv").body.x_max_m;
  for (double y = 0; y <= 50; y += 0.8) wall.push_back({nose_m + free_m + 0.6, y, 0.6, 2});
  PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat, wall));
  problem.start.speed_mps = 3;
  return problem;
}

std::optional<std::string> crash(const PlanningProblem& problem) {
  return crash_ahead(World(problem, WorldUse::kVerdict, 1));
}

}  // namespace

TEST(CrashAhead, AWallNearerThanStoppingAndTurningTakeIsNamed) {
  const std::optional<std::string> reason = crash(before_a_wall(5));
  ASSERT_TRUE(reason);
  EXPECT_NE(reason->find("stop"), std::string::npos) << *reason;
  EXPECT_NE(reason->find("15 m"), std::string::npos) << *reason;  // 3^2 / (2 * 0.3)
  EXPECT_NE(reason->find("obstacle"), std::string::npos) << *reason;
}

TEST(CrashAhead, WhoCanStopHasNoCrashAhead) {
  EXPECT_FALSE(crash(before_a_wall(17)));
}

TEST(CrashAhead, AtRestThereIsNone) {
  PlanningProblem problem = before_a_wall(5);
  problem.start.speed_mps = 0;
  EXPECT_FALSE(crash(problem));
}

}  // namespace regoplan
