#include "benchmarking/experiment.h"

#include <gtest/gtest.h>

#include "tests/benchmarking/made_up_runs.h"

namespace regoplan {
namespace {

TEST(BenchmarkExperiment, ItsProgressHasTheTimeFirstWhateverElseAPlannerTells) {
  RunRecord run = verified_run("a", "RRT", 1, 0.2, 30);
  run.outcome.progress_names = {"best cost REAL", "nodes INTEGER", "time REAL",
                                "witnesses INTEGER"};
  run.outcome.progress = {{"30", "7", "0.05", "9"}, {"25", "8", "0.1", "10"}};
  const auto experiments = experiments_of({.origins = {made_up_origin()}, .runs = {run}});
  ASSERT_EQ(experiments.size(), 1U);
  const PlannerRuns& runs = experiments.front().planners.front();
  const std::vector<std::string> names{"time REAL", "best cost REAL", "nodes INTEGER",
                                       "witnesses INTEGER"};
  EXPECT_EQ(runs.progress_properties, names);
  EXPECT_EQ(runs.runs.front().outcome.progress_names, names);
  const std::vector<std::vector<std::string>> samples{{"0.05", "30", "7", "9"},
                                                      {"0.1", "25", "8", "10"}};
  EXPECT_EQ(runs.runs.front().outcome.progress, samples);
}

}  // namespace
}  // namespace regoplan
