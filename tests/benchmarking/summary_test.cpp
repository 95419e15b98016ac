#include "benchmarking/summary.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/benchmarking/made_up_runs.h"

namespace regoplan {
namespace {

TEST(WilsonInterval, IsThatOfTheTextbooks) {
  // Newcombe (1998), Statistics in Medicine 17, table I: 81 of 263, 0 of 20.
  const auto many = wilson_ci95(81, 263);
  EXPECT_NEAR(many[0], 0.2553, 5e-5);
  EXPECT_NEAR(many[1], 0.3662, 5e-5);
  const auto none = wilson_ci95(0, 20);
  EXPECT_NEAR(none[0], 0, 1e-15);
  EXPECT_NEAR(none[1], 0.1611, 5e-5);
}

TEST(Median, IsTheMiddleOrTheMeanOfTheTwoMiddleValues) {
  EXPECT_EQ(median({3, 1, 2}), 2);
  EXPECT_EQ(median({4, 1, 2, 3}), 2.5);
}

TEST(MedianInterval, LiesBetweenTheOrderedValuesThatTheBinomialNames) {
  // Of six values all lie on one side of the median once in 32 times, of five once in 16. Of ten
  // the second and the ninth: one or none lies below it in 1.1 % of cases, two or fewer in 5.5 %.
  EXPECT_EQ(median_ci95({5, 1, 4, 2, 3}), std::nullopt);
  EXPECT_EQ(median_ci95({6, 5, 1, 4, 2, 3}), (std::array<double, 2>{1, 6}));
  EXPECT_EQ(median_ci95({10, 6, 5, 9, 1, 7, 4, 8, 2, 3}), (std::array<double, 2>{2, 9}));
}

TEST(Summary, CountsOnlyWhatTheExactModelConfirms) {
  PlannerRuns runs{
      .planner = "RRT",
      .settings = {},
      .properties = {},
      .progress_properties = {},
      .runs = {verified_run("a", "RRT", 1, 1, 30), verified_run("a", "RRT", 2, 3, 50)}};
  RunRecord overturned = verified_run("a", "RRT", 3, 0.001, 1);
  overturned.outcome.properties["verified BOOLEAN"] = "0";
  overturned.outcome.properties["overturned BOOLEAN"] = "1";
  runs.runs.push_back(overturned);
  runs.runs.push_back({.key = {.experiment = "a", .planner = "RRT", .seed = 4},
                       .outcome = crashed_run(4, "ended by signal 11")});
  const PlannerSummary summary = summary_of(runs);
  EXPECT_EQ(summary.runs, 4);
  EXPECT_EQ(summary.verified, 2);
  EXPECT_EQ(summary.overturned, 1);
  EXPECT_EQ(summary.crashed, 1);
  EXPECT_EQ(summary.time_median_s, 2);
  EXPECT_EQ(summary.length_median_m, 40);
}

BenchmarkExperiment paired_experiment(double factor, double scatter) {
  BenchmarkExperiment experiment{
      .name = "a", .parameters = {}, .origin = made_up_origin(), .planners = {}};
  PlannerRuns first{.planner = "RRT"}, second{.planner = "SST"};
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    // Seeds differ ten times more than planners: only the pairs show it.
    const double base = 1 + static_cast<double>(seed);
    const double wobble = std::exp(scatter * std::sin(static_cast<double>(7 * seed)));
    first.runs.push_back(verified_run("a", "RRT", seed, base * factor * wobble, 1));
    second.runs.push_back(verified_run("a", "SST", seed, base, 1));
  }
  experiment.planners = {first, second};
  return experiment;
}

TEST(PairedComparison, FindsADifferenceThatThePairsShowAndTheMediansHide) {
  const auto pairs = paired_comparisons(paired_experiment(1.1, 0.05), "time REAL");
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_EQ(pairs.front().pairs, 20);
  EXPECT_NEAR(pairs.front().ratio, 1.1, 0.03);
  EXPECT_TRUE(pairs.front().real);
  EXPECT_LE(pairs.front().ratio_ci95[0], pairs.front().ratio);
  EXPECT_GE(pairs.front().ratio_ci95[1], pairs.front().ratio);
}

TEST(PairedComparison, ClaimsNoDifferenceWhereThereIsNone) {
  const auto pairs = paired_comparisons(paired_experiment(1.0, 0.3), "time REAL");
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_FALSE(pairs.front().real);
}

TEST(PairedComparison, SaysNothingOfFewerThanFivePairs) {
  BenchmarkExperiment experiment = paired_experiment(2, 0);
  experiment.planners.front().runs.resize(4);
  EXPECT_TRUE(paired_comparisons(experiment, "time REAL").empty());
}

}  // namespace
}  // namespace regoplan
