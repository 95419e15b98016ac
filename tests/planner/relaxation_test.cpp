#include "planner/relaxation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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
  const std::vector<RelaxedAnswer> answers = relaxed_answers(problem, kNoHurry, {});
  ASSERT_FALSE(answers.empty());
  EXPECT_EQ(answers.back().given_up, "with slope_max_deg 15");
  ASSERT_TRUE(answers.back().opened);
  const Candidate& opened = *answers.back().opened;
  EXPECT_TRUE(opened.verified.passed);
  const TrajectoryPoint& end = opened.points.back();
  EXPECT_LE(std::hypot(end.x_m - problem.goal.x_m, end.y_m - problem.goal.y_m),
            problem.goal.radius_m);
  for (std::size_t i = 0; i + 1 < answers.size(); ++i) EXPECT_FALSE(answers[i].opened);
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
  const std::vector<RelaxedAnswer> answers = relaxed_answers(problem, kNoHurry, {});
  EXPECT_EQ(answers.size(), relaxations_of(problem).size());
  for (const RelaxedAnswer& answer : answers) EXPECT_FALSE(answer.opened) << answer.given_up;
}

TEST(Relaxation, AnInterruptEndsIt) {
  std::stop_source stop;
  stop.request_stop();
  const PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat));
  EXPECT_TRUE(relaxed_answers(problem, kNoHurry, stop.get_token()).empty());
}

}  // namespace
}  // namespace regoplan
