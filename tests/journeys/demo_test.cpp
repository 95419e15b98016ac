// What the demo shows, as a promise: the physics decides, not a tuned constant.
#include <gtest/gtest.h>

#include "app/demo/demo_scenario.h"
#include "planner/plan.h"

namespace regoplan {
TEST(Demo, ThePhysicsDecides) {
  // By iterations, so that it is the same on every machine.
  PlanningProblem problem = demo_problem({});
  problem.search.time_s.reset();
  problem.search.iterations = 4000;
  problem.search.candidates = 3;
  const PlanResult result = plan(problem);

  ASSERT_EQ(result.status, PlanStatus::kFeasible) << result.reason;
  ASSERT_GE(result.candidates.size(), 3u);
  for (const Candidate& candidate : result.candidates) {
    EXPECT_TRUE(candidate.verified.passed);
    EXPECT_GE(candidate.verified.margin_min, problem.limits.margin_min);
  }
  for (std::size_t i = 1; i < result.candidates.size(); ++i) {
    // Who ranks lower is no better than the sampling error of who ranks higher.
    EXPECT_GE(result.candidates[i - 1].spread->p05_high, result.candidates[i].spread->p05);
  }
  EXPECT_GT(result.rejected[static_cast<std::size_t>(Rejection::kCornering)], 0);

  ASSERT_EQ(result.what_ifs.size(), 3u);
  const WhatIf& twice_as_fast = result.what_ifs[0];
  EXPECT_FALSE(twice_as_fast.feasible);
  EXPECT_EQ(twice_as_fast.reason, Rejection::kCornering);
  const WhatIf& same_controls_on_weaker_soil = result.what_ifs[2];
  ASSERT_TRUE(same_controls_on_weaker_soil.end_shift_m);
  EXPECT_GT(*same_controls_on_weaker_soil.end_shift_m, 1);
}

}  // namespace regoplan
