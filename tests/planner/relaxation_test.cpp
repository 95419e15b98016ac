#include "planner/relaxation.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/planner/planner_run.h"

namespace regoplan {
namespace {

const TimeBudget kNoHurry(TimeBudget::Clock::now(), std::nullopt);

TEST(Relaxation, NamesTheSlopeLimitWhereOnlyASteeperOneOpensTheWay) {
  // A bank from edge to edge, steeper than the limit, on ground that carries the vehicle up it.
  PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), [](double x, double) {
    return std::tan(14 * kTestDegree) * std::clamp(x - 22, 0.0, 6.0);
  }));
  problem.limits.slope_max_rad = 10 * kTestDegree;
  EXPECT_EQ(relaxation_that_helps(problem, kNoHurry, {}).value_or(""), "with slope_max_deg 15");
}

TEST(Relaxation, EveryOneIsAProblemThatCanBeAsked) {
  PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat));
  for (const double start_mps : {0.0, 1.5, 2.5}) {
    problem.start.speed_mps = start_mps;
    for (const Relaxation& relaxation : relaxations_of(problem)) {
      EXPECT_NO_THROW(validate(relaxation.problem)) << relaxation.words;
      EXPECT_EQ(relaxation.problem.start.speed_mps, start_mps) << relaxation.words;
    }
  }
}

TEST(Relaxation, NamesNothingWhereNothingHelps) {
  const PlanningProblem problem =
      lrv_problem(one_soil_map(50, firm_regolith(), flat, ring_of_rocks(40, 25, 7)));
  EXPECT_EQ(relaxation_that_helps(problem, kNoHurry, {}), std::nullopt);
}

TEST(Relaxation, AnInterruptEndsIt) {
  std::stop_source stop;
  stop.request_stop();
  const PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat));
  EXPECT_EQ(relaxation_that_helps(problem, kNoHurry, stop.get_token()), std::nullopt);
}

}  // namespace
}  // namespace regoplan
