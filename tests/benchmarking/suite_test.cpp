#include "benchmarking/suite.h"

#include <gtest/gtest.h>

#include <set>
#include <tuple>

namespace regoplan {
namespace {

Suite small_suite() {
  return {.name = "small",
          .scenarios = {{.label = "a", .file = ""}, {.label = "b", .file = ""}},
          .sweep = {{{"speed_mps.max", 1}}, {{"speed_mps.max", 2}}},
          .planners = {{.label = "RRT", .planner = "RRT", .parameters = {}},
                       {.label = "SST", .planner = "SST", .parameters = {}},
                       {.label = "EST", .planner = "EST", .parameters = {}}},
          .seeds = {1, 2, 3, 4, 5},
          .bounds = {}};
}

using Key = std::tuple<std::size_t, std::size_t, std::size_t, std::uint64_t>;

TEST(Suite, ShardsAreDisjointAndTogetherTheSuite) {
  const Suite suite = small_suite();
  std::set<Key> all;
  std::size_t count = 0;
  for (int index = 1; index <= 4; ++index) {
    for (const SuiteRun& run : runs_of(suite, {.index = index, .count = 4})) {
      all.insert({run.scenario, run.sweep_point, run.planner, run.seed});
      ++count;
    }
  }
  EXPECT_EQ(count, 60U);
  EXPECT_EQ(all.size(), 60U);
  EXPECT_EQ(runs_of(suite, {}).size(), 60U);
}

TEST(Suite, ShardsDifferByOneRunAtMost) {
  const Suite suite = small_suite();
  for (int index = 1; index <= 7; ++index) {
    const std::size_t size = runs_of(suite, {.index = index, .count = 7}).size();
    EXPECT_GE(size, 60U / 7);
    EXPECT_LE(size, 60U / 7 + 1);
  }
}

TEST(Suite, PlannersTakeTurnsSeedBySeed) {
  const std::vector<SuiteRun> runs = runs_of(small_suite(), {});
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(runs[i].planner, i);
    EXPECT_EQ(runs[i].seed, 1U);
  }
  EXPECT_EQ(runs[3].seed, 2U);
}

TEST(Suite, ExperimentsAreNamedAfterScenarioAndSweepWithoutSpaces) {
  EXPECT_EQ(experiment_name(small_suite(), 1, 1), "b,speed_mps.max=2");
  Suite plain = small_suite();
  plain.sweep = {{}};
  EXPECT_EQ(experiment_name(plain, 0, 0), "a");
}

}  // namespace
}  // namespace regoplan
