#include "planner/relaxation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/planner/planner_run.h"

namespace regoplan {
namespace {

const TimeBudget kNoHurry(TimeBudget::Clock::now(), std::nullopt);

std::size_t count_of(const std::vector<std::vector<Relaxation>>& steps) {
  std::size_t count = 0;
  for (const auto& step : steps) count += step.size();
  return count;
}

TEST(Relaxation, NamesTheSlopeLimitWhereOnlyASteeperOneOpensTheWay) {
  // A bank from edge to edge, steeper than the limit, on ground that carries the vehicle up it.
  PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), [](double x, double) {
    return std::tan(14 * kTestDegree) * std::clamp(x - 22, 0.0, 6.0);
  }));
  problem.limits.slope_max_rad = 10 * kTestDegree;
  // Neither 2.5 deg more nor half of anything else opens it: 5 deg more do.
  const std::vector<RelaxedAnswer> answers = relaxed_search(problem, nullptr, kNoHurry, {}).answers;
  EXPECT_EQ(answers.size(), count_of(relaxations_of(problem)));
  std::vector<std::string> opening;
  for (const RelaxedAnswer& answer : answers) {
    if (!answer.opened) continue;
    opening.push_back(answer.given_up);
    EXPECT_TRUE(answer.opened->verified.passed);
    const TrajectoryPoint& end = answer.opened->points.back();
    EXPECT_LE(std::hypot(end.x_m - problem.goal.x_m, end.y_m - problem.goal.y_m),
              problem.goal.radius_m);
  }
  EXPECT_EQ(opening, std::vector<std::string>{"with slope_max_deg 15"});
}

TEST(Relaxation, SmallChangesThatHelpStandSideBySideAndLargeOnesAreNotAsked) {
  // Steeper than the limit by less than the small change.
  PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), [](double x, double) {
    return std::tan(11.5 * kTestDegree) * std::clamp(x - 22, 0.0, 6.0);
  }));
  problem.limits.slope_max_rad = 10 * kTestDegree;
  const auto steps = relaxations_of(problem);
  const std::vector<RelaxedAnswer> answers = relaxed_search(problem, nullptr, kNoHurry, {}).answers;
  ASSERT_EQ(answers.size(), steps.front().size());
  for (std::size_t i = 0; i < answers.size(); ++i) {
    EXPECT_EQ(answers[i].given_up, steps.front()[i].words);
    EXPECT_EQ(answers[i].opened.has_value(), answers[i].given_up == "with slope_max_deg 12.5");
  }
}

TEST(Relaxation, StrongerSoilIsAskedWhereFrictionIsUncertain) {
  PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat));
  const auto asks_for_soil = [&problem] {
    return std::ranges::any_of(relaxations_of(problem).front(), [](const Relaxation& relaxation) {
      return relaxation.words ==
             "if friction_angle_deg of every soil were one standard deviation higher";
    });
  };
  EXPECT_FALSE(asks_for_soil());
  std::vector<MapSoil> soils = problem.map.soils();
  soils.front().soil.standard_deviation.friction_angle_rad = 2 * kTestDegree;
  problem.map = problem.map.with_soils(soils);
  EXPECT_TRUE(asks_for_soil());
}

TEST(Relaxation, EveryOneIsAProblemThatCanBeAsked) {
  PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat));
  for (const double start_mps : {0.0, 1.5, 2.5}) {
    problem.start.speed_mps = start_mps;
    for (const auto& step : relaxations_of(problem)) {
      for (const Relaxation& relaxation : step) {
        EXPECT_NO_THROW(validate(relaxation.problem)) << relaxation.words;
        EXPECT_EQ(relaxation.problem.start.speed_mps, start_mps) << relaxation.words;
      }
    }
  }
}

TEST(Relaxation, NoLargerGoalHoldsTheStart) {
  PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat));
  problem.goal.x_m = problem.start.x_m + 10;
  problem.goal.radius_m = 3;
  std::vector<double> larger_m;
  for (const auto& step : relaxations_of(problem)) {
    for (const Relaxation& relaxation : step) {
      const double radius_m = relaxation.problem.goal.radius_m;
      if (radius_m != 3) larger_m.push_back(radius_m);
    }
  }
  EXPECT_EQ(larger_m, std::vector<double>{6});  // 12 m would hold it
}

TEST(Relaxation, NamesNothingWhereNothingHelps) {
  const PlanningProblem problem =
      lrv_problem(one_soil_map(50, firm_regolith(), flat, ring_of_rocks(10, 25, 7)));
  const std::vector<RelaxedAnswer> answers = relaxed_search(problem, nullptr, kNoHurry, {}).answers;
  EXPECT_EQ(answers.size(), count_of(relaxations_of(problem)));
  for (const RelaxedAnswer& answer : answers) EXPECT_FALSE(answer.opened) << answer.given_up;
}

TEST(Relaxation, NoLimitIsBlamedForAPathThatKeepsThemAll) {
  const PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat));
  const World asked(problem, WorldUse::kVerdict, 1);
  const RelaxedSearch search = relaxed_search(problem, &asked, kNoHurry, {});
  ASSERT_TRUE(search.within_limits);
  const Candidate& path = search.within_limits->candidate;
  EXPECT_TRUE(path.verified.passed);
  EXPECT_GE(path.margin_min, problem.limits.margin_min);
  const TrajectoryPoint& end = path.points.back();
  EXPECT_LE(std::hypot(end.x_m - problem.goal.x_m, end.y_m - problem.goal.y_m),
            problem.goal.radius_m);
  // Who keeps to less speed keeps to more. A larger goal may be reached by a path that ends short
  // of the one that was asked for.
  for (const RelaxedAnswer& answer : search.answers) {
    EXPECT_TRUE(!answer.opened || answer.given_up == "with a goal of radius_m 6")
        << answer.given_up;
  }
}

TEST(Relaxation, AnInterruptEndsIt) {
  std::stop_source stop;
  stop.request_stop();
  const PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat));
  EXPECT_TRUE(relaxed_search(problem, nullptr, kNoHurry, stop.get_token()).answers.empty());
}

}  // namespace
}  // namespace regoplan
