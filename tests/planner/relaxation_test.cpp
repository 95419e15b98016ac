#include "planner/relaxation.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/planner/planner_run.h"

namespace regoplan {

TEST(Relaxation, NamesTheSlopeLimitWhereOnlyASteeperOneOpensTheWay) {
  // A bank from edge to edge, steeper than the limit, on ground that carries the vehicle up it.
  PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), [](double x, double) {
    return std::tan(14 * kTestDegree) * std::clamp(x - 22, 0.0, 6.0);
  }));
  problem.limits.slope_max_rad = 10 * kTestDegree;
  EXPECT_EQ(relaxation_that_helps(problem, {}).value_or(""), "with slope_max_deg 15");
}

TEST(Relaxation, NamesNothingWhereNothingHelps) {
  const PlanningProblem problem =
      lrv_problem(one_soil_map(50, firm_regolith(), flat, ring_of_rocks(40, 25, 7)));
  EXPECT_EQ(relaxation_that_helps(problem, {}), std::nullopt);
}

TEST(Relaxation, AnInterruptEndsIt) {
  std::stop_source stop;
  stop.request_stop();
  const PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat));
  EXPECT_EQ(relaxation_that_helps(problem, stop.get_token()), std::nullopt);
}

}  // namespace regoplan
