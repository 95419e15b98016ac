#include "planner/verdict/verified_path.h"

#include <gtest/gtest.h>

#include "tests/planner/flat_problem.h"

namespace regoplan {
namespace {

/// Straight on at walking pace, for so long.
FoundPath straight_on(double duration_s) {
  return {.planner = "made up",
          .controls = {{.duration_s = duration_s, .speed_target_mps = 2},
                       {.duration_s = 12, .speed_target_mps = 0}}};
}

TEST(VerifiedPath, IsDrivenWithStepsTenTimesFinerThanTheSearchs) {
  const PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat));
  const World verdict(problem, WorldUse::kVerdict, 1);
  const ReplaySteps steps = verification_steps(verdict);
  EXPECT_EQ(steps.fine_per_coarse, 10);
  EXPECT_EQ(steps.coarse_s, verdict.search_step_s());
}

TEST(VerifiedPath, EndingShortOfTheGoalIsNoPathThere) {
  const PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat));
  const World verdict(problem, WorldUse::kVerdict, 1), searched(problem, WorldUse::kSearch, 1);
  const VerifiedPath there = verify(verdict, searched, straight_on(14));
  EXPECT_TRUE(there.candidate.verified.passed) << there.candidate.verified.reason;
  const VerifiedPath shorter = verify(verdict, searched, straight_on(8));
  EXPECT_FALSE(shorter.candidate.verified.passed);
  EXPECT_NE(shorter.candidate.verified.reason.find("the goal is not reached"), std::string::npos);
}

}  // namespace
}  // namespace regoplan
