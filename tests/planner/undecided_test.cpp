#include "planner/certificate/undecided.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/planner/flat_problem.h"

namespace regoplan {
namespace {

PlanningProblem problem_with(std::optional<double> time_s) {
  PlanningProblem problem = lrv_problem(one_soil_map(50, firm_regolith(), flat));
  problem.search.time_s = time_s;
  if (time_s) problem.search.iterations.reset();
  return problem;
}

TEST(Undecided, ASearchThatTheTimeCutShortIsGivenMore) {
  const std::string why = why_undecided(problem_with(2), {}, {.found = 0, .cut_short = true});
  EXPECT_EQ(why, "2 s did not suffice, give it 5 s: no path was found");
}

TEST(Undecided, TheTimeThatIsAskedForHoldsWhatGoesBeforeTheSearch) {
  PlanResult result;
  result.before_search = {{.step = "certificates", .time_s = 0.2},
                          {.step = "force tables", .time_s = 0.4}};
  EXPECT_EQ(why_undecided(problem_with(0.01), result, {.found = 0, .cut_short = true}),
            "0.01 s did not suffice, give it 1 s: no path was found");
}

TEST(Undecided, ASearchThatCameToItsEndIsNotSentOnForTime) {
  EXPECT_EQ(why_undecided(problem_with(2), {}, {}), "no path was found");
  EXPECT_EQ(why_undecided(problem_with({}), {}, {.cut_short = true}), "no path was found");
}

TEST(Undecided, AnInterruptedSearchSaysNothingOfTheTime) {
  EXPECT_EQ(why_undecided(problem_with(60), {}, {.cut_short = true, .interrupted = true}),
            "no path was found");
  EXPECT_EQ(why_undecided(problem_with(60), {}, {.found = 1, .unverified = 1, .interrupted = true}),
            "1 path was found and not yet verified");
}

TEST(Undecided, APathThatWaitsForItsVerificationIsSaid) {
  const std::string why =
      why_undecided(problem_with(1), {}, {.found = 1, .unverified = 1, .cut_short = false});
  EXPECT_EQ(why, "1 s did not suffice, give it 5 s: 1 path was found and not yet verified");
}

TEST(Undecided, ALimitThatASearchSetItselfIsNotTakenForTheScenarios) {
  PlanResult result;
  result.rejected_states = {{.reason = Rejection::kTraction,
                             .x_m = 30,
                             .y_m = 25,
                             .exceeded = Exceeded{.found = 0.149, .limit = 0.15}}};
  const std::string why = why_undecided(problem_with({}), result, {});
  EXPECT_NE(why.find("this search kept a reserve, the scenario asks 0.05"), std::string::npos)
      << why;
}

TEST(Undecided, AMostThatASearchSetItselfIsNotTakenForTheScenariosEither) {
  const PlanningProblem problem = problem_with({});
  PlanResult result;
  result.rejected_states = {{.reason = Rejection::kSpeed,
                             .x_m = 30,
                             .y_m = 25,
                             .exceeded = Exceeded{.found = 0.997 * problem.speed_max_mps,
                                                  .limit = 0.995 * problem.speed_max_mps}}};
  const std::string why = why_undecided(problem, result, {});
  EXPECT_NE(why.find(fmt::format("this search kept a reserve, the scenario allows {:.4g} m/s",
                                 problem.speed_max_mps)),
            std::string::npos)
      << why;
}

TEST(Undecided, NamesTheNarrowestPlaceNearestToTheGoal) {
  PlanResult result;
  const auto add = [&](Rejection reason, double x_m, double value) {
    result.rejected_states.push_back({.reason = reason,
                                      .x_m = x_m,
                                      .y_m = 25,
                                      .exceeded = Exceeded{.found = value, .limit = 0.05}});
  };
  add(Rejection::kTraction, 12, 0.049);  // far from the goal at 40 m: not what stops it
  add(Rejection::kTraction, 12, 0.049);
  add(Rejection::kTraction, 12, 0.049);
  add(Rejection::kCornering, 30, -0.2);
  add(Rejection::kCornering, 30, 0.03);  // this one misses by least
  add(Rejection::kSlip, 30, 0.9);
  const std::string why = why_undecided(problem_with({}), result, {});
  EXPECT_NE(why.find("cornering margin 0.03 (allowed: at least 0.05) at (30.00, 25.00)"),
            std::string::npos)
      << why;
  EXPECT_NE(why.find("with at least 7 m to go"), std::string::npos) << why;
}

/// As searches keep them: of each reason a few, however many states it refused.
PlanResult refused_by_slope_and_seldom_by_speed(double slope_x_m) {
  PlanResult result;
  result.rejected_states = {{.reason = Rejection::kSpeed,
                             .x_m = 30,
                             .y_m = 25,
                             .exceeded = Exceeded{.found = 1.991, .limit = 1.99}},
                            {.reason = Rejection::kSpeed,
                             .x_m = 30,
                             .y_m = 25,
                             .exceeded = Exceeded{.found = 1.992, .limit = 1.99}},
                            {.reason = Rejection::kSlope,
                             .x_m = slope_x_m,
                             .y_m = 25,
                             .exceeded = Exceeded{.found = 0.44, .limit = 0.43}}};
  result.rejected[static_cast<std::size_t>(Rejection::kSpeed)] = 485;
  result.rejected[static_cast<std::size_t>(Rejection::kSlope)] = 42788;
  return result;
}

TEST(Undecided, WhatRefusedMostNearTheGoalIsCountedAndNotHowManyOfItWereKept) {
  const std::string why =
      why_undecided(problem_with({}), refused_by_slope_and_seldom_by_speed(30), {});
  EXPECT_NE(why.find("m to go, it was stopped by slope 25.21 deg"), std::string::npos) << why;
  EXPECT_EQ(why.find("most often"), std::string::npos) << why;
}

TEST(Undecided, AReasonThatIsRareIsToldBesideTheOneThatRefusedMost) {
  const std::string why =
      why_undecided(problem_with({}), refused_by_slope_and_seldom_by_speed(12), {});
  EXPECT_NE(why.find("m to go, it was stopped by speed 1.991 m/s"), std::string::npos) << why;
  EXPECT_TRUE(
      why.ends_with("; most often, in 42788 of 43273 refusals, it was stopped by slope "
                    "25.21 deg (allowed: at most 24.64 deg)"))
      << why;
}

}  // namespace
}  // namespace regoplan
