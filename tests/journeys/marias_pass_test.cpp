// Real terrain: between two of Curiosity's stops in Gale crater.
#include <gtest/gtest.h>

#include "app/settings/scenario_settings.h"
#include "planner/plan.h"
#include "tests/measured_data.h"

namespace regoplan {

TEST(MariasPass, ACuriosityClassRoverDrivesFromOneOfItsStopsToAnother) {
  const std::filesystem::path data = measured_data();
  if (const auto absence = absence_of(data / "mars_gale_marias_pass")) GTEST_SKIP() << *absence;
  setenv("REGOPLAN_DATA", data.c_str(), 1);
  PlanningProblem problem =
      read_scenario(REGOPLAN_SOURCE_DIR "/scenarios/marias_pass/scenario.yaml", {}).problem;
  const double apart_m =
      std::hypot(problem.goal.x_m - problem.start.x_m, problem.goal.y_m - problem.start.y_m);
  EXPECT_GE(apart_m, 60);
  problem.search.time_s.reset();
  problem.search.iterations = 2500;
  problem.search.candidates = 1;
  problem.search.soil_draws = 20;
  const PlanResult result = plan(problem);
  ASSERT_EQ(result.status, PlanStatus::kFeasible) << result.reason;
  const Candidate& best = result.candidates.front();
  EXPECT_TRUE(best.verified.passed);
  EXPECT_GE(best.length_m, apart_m - problem.goal.radius_m);
  EXPECT_GE(best.margin_min, problem.limits.margin_min);
}

}  // namespace regoplan
