#include "benchmarking/results_database.h"

#include <gtest/gtest.h>
#include <sqlite3.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "benchmarking/ompl_log.h"
#include "tests/benchmarking/made_up_runs.h"

namespace regoplan {
namespace {

JournalContents two_experiments() {
  JournalContents contents{.origins = {made_up_origin()}, .runs = {}};
  for (const char* experiment : {"a", "b,speed_mps.max=2"}) {
    for (const char* planner : {"RRT", "SST"}) {
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        contents.runs.push_back(
            verified_run(experiment, planner, seed, 0.25 * static_cast<double>(seed), 30));
      }
    }
  }
  contents.runs.push_back({.key = {.experiment = "a", .planner = "SST", .seed = 4},
                           .outcome = crashed_run(4, "ended by signal 11; badly\nindeed")});
  return contents;
}

/// Every row of a query as one text.
std::string rows(const std::filesystem::path& file, const std::string& sql) {
  sqlite3* database = nullptr;
  EXPECT_EQ(sqlite3_open(file.c_str(), &database), SQLITE_OK);
  std::string text;
  const auto add_row = [](void* to, int count, char** values, char**) {
    for (int i = 0; i < count; ++i) {
      *static_cast<std::string*>(to) += std::string(values[i] ? values[i] : "NULL") + "|";
    }
    *static_cast<std::string*>(to) += "\n";
    return 0;
  };
  EXPECT_EQ(sqlite3_exec(database, sql.c_str(), add_row, &text, nullptr), SQLITE_OK)
      << sqlite3_errmsg(database) << " in " << sql;
  sqlite3_close(database);
  return text;
}

class Database : public testing::Test {
 protected:
  Database()
      : folder_(std::filesystem::temp_directory_path() /
                ("regoplan-database-" + std::to_string(getpid()))) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    write_results_database(ours(), experiments_of(two_experiments()));
  }
  ~Database() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path ours() const { return folder_ / "ours.db"; }
  std::filesystem::path folder_;
};

TEST_F(Database, HasTheFiveTablesAndEveryRun) {
  EXPECT_EQ(rows(ours(),
                 "SELECT name FROM sqlite_master WHERE type = 'table' AND name NOT LIKE "
                 "'sqlite%' ORDER BY name"),
            "enums|\nexperiments|\nplannerConfigs|\nprogress|\nruns|\n");
  EXPECT_EQ(rows(ours(), "SELECT count(*) FROM runs"), "13|\n");
  EXPECT_EQ(rows(ours(), "SELECT name, speed_mps_max FROM experiments ORDER BY name"),
            "a|NULL|\nb,speed_mps.max=2|2.0|\n");
}

TEST_F(Database, KeepsTheFirstOfTwoProgressSamplesOfOneMoment) {
  EXPECT_EQ(rows(ours(), "SELECT time, best_cost FROM progress WHERE runid = 1 ORDER BY time"),
            "0.05|30.0|\n0.1|25.0|\n");
}

TEST_F(Database, IsWhatOmplsOwnReaderMakesOfTheLogs) {
  if (std::system("command -v ompl_benchmark_statistics >/dev/null") != 0) {
    GTEST_SKIP() << "ompl_benchmark_statistics is not installed (Debian's ompl-demos)";
  }
  std::string files;
  int number = 0;
  for (const BenchmarkExperiment& experiment : experiments_of(two_experiments())) {
    const std::filesystem::path file = folder_ / (std::to_string(++number) + ".log");
    std::ofstream(file) << ompl_log(experiment);
    files += " '" + file.string() + "'";
  }
  const std::filesystem::path theirs = folder_ / "theirs.db";
  ASSERT_EQ(std::system(("ompl_benchmark_statistics" + files + " -d '" + theirs.string() +
                         "' >/dev/null 2>&1")
                            .c_str()),
            0);
  const std::string runs =
      "SELECT e.name, p.name, p.settings, r.time, r.path_length_m, r.verified, r.random_seed, "
      "r.status, typeof(r.time), typeof(r.random_seed) FROM runs r "
      "JOIN experiments e ON e.id = r.experimentid JOIN plannerConfigs p ON p.id = r.plannerid "
      "ORDER BY 1, 2, 7";
  EXPECT_EQ(rows(ours(), runs), rows(theirs, runs));
  const std::string progress =
      "SELECT e.name, p.name, r.random_seed, g.time, g.best_cost FROM progress g "
      "JOIN runs r ON r.id = g.runid JOIN experiments e ON e.id = r.experimentid "
      "JOIN plannerConfigs p ON p.id = r.plannerid ORDER BY 1, 2, 3, 4";
  EXPECT_EQ(rows(ours(), progress), rows(theirs, progress));
  EXPECT_EQ(rows(ours(), "SELECT * FROM enums ORDER BY value"),
            rows(theirs, "SELECT * FROM enums ORDER BY value"));
  const std::string heads =
      "SELECT name, timelimit, memorylimit, runcount, version, hostname, date, seed FROM "
      "experiments ORDER BY name";
  EXPECT_EQ(rows(ours(), heads), rows(theirs, heads));
}

}  // namespace
}  // namespace regoplan
