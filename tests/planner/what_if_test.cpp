// What the best candidate would be under other circumstances.
#include "planner/driving/what_if.h"

#include <gtest/gtest.h>

#include <cmath>

#include "planner/driving/margin_draws.h"
#include "tests/planner/flat_problem.h"

namespace regoplan {
namespace {

constexpr int kDraws = 20;

/// A turn at 3 m/s on soil whose friction is known to 5 deg.
class WhatIfInATurn : public testing::Test {
 protected:
  static PlanningProblem problem() {
    UncertainSoil soil = firm_regolith();
    soil.standard_deviation.friction_angle_rad = 5 * kTestDegree;
    PlanningProblem problem = lrv_problem(one_soil_map(60, soil, flat));
    problem.limits.margin_min = 0.2;
    return problem;
  }

  double share_that_holds() const {
    const auto smallest =
        smallest_margins(problem_, driven_, {.count = kDraws}, problem_.search.seed, 1);
    return margin_spread(smallest, problem_.limits.margin_min).feasible.share;
  }

  PlanningProblem problem_ = problem();
  World world_{problem_, WorldUse::kVerdict, 1};
  std::vector<ControlSegment> controls_{
      {.duration_s = 8, .speed_target_mps = 3, .curvature_target_1pm = 0.06}};
  Replay driven_ = replay(world_, controls_, verification_steps(world_));
};

TEST_F(WhatIfInATurn, SlowedDownUntilEnoughDrawsHold) {
  ASSERT_LT(share_that_holds(), 0.95);
  const WhatIf slower = slow_enough(world_, driven_, kDraws, 0.95);
  ASSERT_TRUE(slower.probability);
  EXPECT_GE(slower.probability->share, 0.95) << slower.question;
  EXPECT_TRUE(slower.feasible);
  EXPECT_NE(slower.question.find("of its speeds"), std::string::npos);
}

TEST_F(WhatIfInATurn, WhereNoSpeedIsSlowEnoughHalfOfItIsTold) {
  const WhatIf slower = slow_enough(world_, driven_, kDraws, 2);  // more than all draws
  EXPECT_EQ(slower.question, "the same path at 0.5 of its speeds");
}

TEST_F(WhatIfInATurn, TwiceTheSpeedIsAskedWithoutHarderBraking) {
  // Braking four times as hard, as half the time would take, is more than the soil can give.
  const std::vector<ControlSegment> braked{
      {.duration_s = 4, .speed_target_mps = 1, .curvature_target_1pm = 0},
      {.duration_s = 6, .speed_target_mps = 0, .curvature_target_1pm = 0}};
  const Replay driven = replay(world_, braked, verification_steps(world_));
  const WhatIf faster = what_if(Circumstance::kTwiceTheSpeed, world_, driven, braked);
  EXPECT_TRUE(faster.feasible);
  EXPECT_NE(faster.question.find("braking as hard as it does"), std::string::npos)
      << faster.question;
}

TEST_F(WhatIfInATurn, TheSameControlsOnWeakerSoilLeadAsFarAwayAsIsSaid) {
  const WhatIf weaker =
      what_if(Circumstance::kSameControlsOnWeakerSoil, world_, driven_, controls_);
  ASSERT_GE(weaker.driven.size(), 2u);
  ASSERT_TRUE(weaker.end_shift_m);
  const auto [x_m, y_m] = weaker.driven.back();
  EXPECT_NEAR(std::hypot(x_m - driven_.end.x_m, y_m - driven_.end.y_m), *weaker.end_shift_m, 1e-9);
  EXPECT_NEAR(weaker.driven.front()[0], problem_.start.x_m, 1e-9);
}

TEST_F(WhatIfInATurn, EnergyAlongTheWayEndsAtThatOfTheWhole) {
  double before_j = 0;
  for (const TrajectoryPoint& point : driven_.points) {
    EXPECT_GE(point.energy_j, before_j - 1);
    before_j = point.energy_j;
  }
  EXPECT_NEAR(driven_.points.back().energy_j, driven_.energy_j, 0.02 * driven_.energy_j);
  EXPECT_GT(driven_.points.back().torque_max_nm, 0);
}

}  // namespace
}  // namespace regoplan
