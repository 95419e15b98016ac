// Suites as a planning researcher meets them: run, killed, gone on with, cut into shards.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <thread>

#include "tests/app/flat_map.h"
#include "tests/app/program_run.h"

namespace regoplan {
namespace {

/// Two scenarios, three planners on flat ground: runs of a tenth of a second, 60 with ten seeds.
void write_suite(const ScratchFolder& folder, int seeds = 10) {
  write_flat_scenario(folder);
  folder.write("suite.yaml",
               fmt::format("name: sixty\n"
                           "scenarios: [scenario.yaml, {{name: again, file: scenario.yaml}}]\n"
                           "planners: [RRT, KPIECE1, {{name: greedy, planner: RRT, "
                           "parameters: {{goal_bias: 0.5}}}}]\n"
                           "seeds: {}\n"
                           "time_s: 30\n"
                           "iterations: 60\n"
                           "soil_draws: 5\n",
                           seeds));
}

std::vector<nlohmann::json> journal(const ScratchFolder& folder, const std::string& out) {
  std::istringstream lines(folder.read(out + "/runs.jsonl"));
  std::vector<nlohmann::json> runs;
  for (std::string line; std::getline(lines, line) && !lines.eof();) {
    nlohmann::json json = nlohmann::json::parse(line);
    if (!json.contains("origin")) runs.push_back(std::move(json));
  }
  return runs;
}

std::string key(const nlohmann::json& run) {
  return fmt::format("{}/{}/{}", run.at("experiment").get<std::string>(),
                     run.at("planner").get<std::string>(), run.at("seed").get<int>());
}

/// What a run came to, by its key, without what depends on the clock or the allocator.
std::map<std::string, nlohmann::json> outcomes(const ScratchFolder& folder,
                                               const std::string& out) {
  std::map<std::string, nlohmann::json> all;
  for (const nlohmann::json& run : journal(folder, out)) {
    nlohmann::json properties = run.at("properties");
    properties.erase("time REAL");
    properties.erase("memory REAL");
    all[key(run)] = properties;
  }
  return all;
}

int count_runs(const std::string& database) {
  sqlite3* handle = nullptr;
  sqlite3_stmt* statement = nullptr;
  EXPECT_EQ(sqlite3_open(database.c_str(), &handle), SQLITE_OK);
  EXPECT_EQ(sqlite3_prepare_v2(handle, "SELECT count(*) FROM runs", -1, &statement, nullptr),
            SQLITE_OK);
  const int count = sqlite3_step(statement) == SQLITE_ROW ? sqlite3_column_int(statement, 0) : -1;
  sqlite3_finalize(statement);
  sqlite3_close(handle);
  return count;
}

std::string benchmark_arguments(const ScratchFolder& folder, const std::string& out,
                                const std::string& more = "") {
  return fmt::format("benchmark '{}' --out '{}' {}", folder.path("suite.yaml"), folder.path(out),
                     more);
}

/// Starts a benchmark and kills it with SIGKILL once its journal has so many lines.
void run_until_killed(const ScratchFolder& folder, const std::string& out, long lines) {
  const pid_t child = fork();
  if (child == 0) {
    const std::string suite = folder.path("suite.yaml"), folder_out = folder.path(out);
    execl(REGOPLAN_PROGRAM, REGOPLAN_PROGRAM, "benchmark", suite.c_str(), "--out",
          folder_out.c_str(), "--quiet", nullptr);
    _exit(127);
  }
  for (int i = 0; i < 3000; ++i) {
    const std::string text = folder.read(out + "/runs.jsonl");
    if (std::count(text.begin(), text.end(), '\n') >= lines) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
}

TEST(BenchmarkProgram, KilledTwiceHoldsEveryRunExactlyOnce) {
  const ScratchFolder folder;
  write_suite(folder);
  run_until_killed(folder, "out", 12);
  const std::size_t first = journal(folder, "out").size();
  EXPECT_GE(first, 10U);
  run_until_killed(folder, "out", 35);
  EXPECT_GT(journal(folder, "out").size(), first);
  const ProgramRun run = run_program(folder, benchmark_arguments(folder, "out"));
  ASSERT_EQ(run.status, 0) << run.errors;
  std::set<std::string> keys;
  for (const nlohmann::json& record : journal(folder, "out")) keys.insert(key(record));
  EXPECT_EQ(keys.size(), 60U);
  EXPECT_EQ(journal(folder, "out").size(), 60U);
  EXPECT_EQ(count_runs(folder.path("out/benchmark.db")), 60);
  const nlohmann::json summary = nlohmann::json::parse(folder.read("out/benchmark.json"));
  EXPECT_EQ(summary.at("runs"), 60);
  EXPECT_EQ(summary.at("interrupted"), false);
  EXPECT_TRUE(std::filesystem::exists(folder.path("out/again.log")));
  EXPECT_NE(folder.read("out/report.html").find("sixty"), std::string::npos);
}

TEST(BenchmarkProgram, ShardsMergeIntoWhatOneMachineFinds) {
  const ScratchFolder folder;
  write_suite(folder, 3);
  ASSERT_EQ(run_program(folder, benchmark_arguments(folder, "whole", "--processes 1")).status, 0);
  std::string parts;
  for (int shard = 1; shard <= 3; ++shard) {
    const std::string part = fmt::format("part{}", shard);
    ASSERT_EQ(run_program(folder, benchmark_arguments(folder, part,
                                                      fmt::format("--shard {}/3 --quiet", shard)))
                  .status,
              0);
    parts += fmt::format(" '{}'", folder.path(part));
  }
  const ProgramRun merge = run_program(
      folder, fmt::format("benchmark merge {} --out '{}'", parts, folder.path("merged")));
  ASSERT_EQ(merge.status, 0) << merge.errors;
  EXPECT_EQ(merge.errors, "");
  EXPECT_EQ(nlohmann::json::parse(folder.read("merged/benchmark.json")).at("interrupted"), false);
  EXPECT_EQ(count_runs(folder.path("merged/benchmark.db")), 18);
  EXPECT_EQ(outcomes(folder, "merged"), outcomes(folder, "whole"));
}

TEST(BenchmarkProgram, AMergeSaysWhichShardIsNotThere) {
  const ScratchFolder folder;
  write_suite(folder, 2);
  for (const int shard : {1, 3}) {
    ASSERT_EQ(run_program(folder, benchmark_arguments(folder, fmt::format("part{}", shard),
                                                      fmt::format("--shard {}/3 --quiet", shard)))
                  .status,
              0);
  }
  const ProgramRun merge =
      run_program(folder, fmt::format("benchmark merge '{}' '{}' --out '{}'", folder.path("part1"),
                                      folder.path("part3"), folder.path("merged")));
  ASSERT_EQ(merge.status, 0) << merge.errors;
  EXPECT_NE(merge.errors.find("4 of 12 runs are missing (the first: "), std::string::npos)
      << merge.errors;
  EXPECT_NE(merge.errors.find("no folder is of shard 2/3"), std::string::npos) << merge.errors;
  EXPECT_EQ(nlohmann::json::parse(folder.read("merged/benchmark.json")).at("interrupted"), true);
}

TEST(BenchmarkProgram, AMergeMissesAShardThatAloneHasASeed) {
  const ScratchFolder folder;
  write_flat_scenario(folder);
  folder.write("suite.yaml",
               "name: two\nscenarios: [scenario.yaml]\nplanners: [RRT]\nseeds: 2\ntime_s: 30\n"
               "iterations: 60\nsoil_draws: 2\n");
  ASSERT_EQ(run_program(folder, benchmark_arguments(folder, "part", "--shard 1/2 --quiet")).status,
            0);
  const ProgramRun merge = run_program(
      folder,
      fmt::format("benchmark merge '{}' --out '{}'", folder.path("part"), folder.path("merged")));
  ASSERT_EQ(merge.status, 0) << merge.errors;
  EXPECT_NE(merge.errors.find("no folder is of shard 2/2"), std::string::npos) << merge.errors;
  EXPECT_EQ(nlohmann::json::parse(folder.read("merged/benchmark.json")).at("interrupted"), true);
}

TEST(BenchmarkProgram, ASweepIsAnExperimentForEachValue) {
  const ScratchFolder folder;
  write_flat_scenario(folder);
  folder.write("suite.yaml",
               "name: sweep\nscenarios: [scenario.yaml]\nplanners: [RRT]\nseeds: [7]\ntime_s: 30\n"
               "iterations: 60\nsoil_draws: 2\nsweep: {speed_mps.max: [1, 2]}\n");
  const ProgramRun run = run_program(folder, benchmark_arguments(folder, "out", "--json"));
  ASSERT_EQ(run.status, 0) << run.errors;
  const nlohmann::json json = nlohmann::json::parse(run.output);
  ASSERT_EQ(json.at("experiments").size(), 2U);
  EXPECT_EQ(json["experiments"][0]["name"], "scenario,speed_mps.max=1");
  EXPECT_GT(json["experiments"][0]["planners"][0]["duration_median_s"].get<double>(),
            json["experiments"][1]["planners"][0]["duration_median_s"].get<double>());
  EXPECT_TRUE(std::filesystem::exists(folder.path("out/scenario_speed_mps.max_1.log")));
}

void expect_refused(const ScratchFolder& folder, const std::string& arguments,
                    const std::string& words) {
  expect_refusal(run_program(folder, arguments), {words});
}

TEST(BenchmarkProgram, RefusesBadInputInOneLine) {
  const ScratchFolder folder;
  const auto refused = [&](const std::string& suite, const std::string& words) {
    write_flat_scenario(folder);
    folder.write("suite.yaml", suite);
    expect_refused(folder, benchmark_arguments(folder, "out"), words);
    EXPECT_TRUE(journal(folder, "out").empty());
  };
  const std::string rest = "seeds: 1\ntime_s: 1\n";
  refused("name: a\nscenarios: [scenario.yaml]\nplanners: [RRTT]\n" + rest,
          "suite.yaml:3: planners[0]: RRTT is not valid");
  refused("name: a\nscenarios: [absent.yaml]\nplanners: [RRT]\n" + rest, "absent.yaml: no such");
  refused("name: a b\nscenarios: [scenario.yaml]\nplanners: [RRT]\n" + rest, "a b is no name");
  refused("name: a\nscenarios: [scenario.yaml, scenario.yaml]\nplanners: [RRT]\n" + rest,
          "scenario stands twice");
  refused("name: a\nscenarios: [scenario.yaml]\nplanners: [RRT]\nseeds: 0\ntime_s: 1\n",
          "suite.yaml:4: seeds: 0 is not valid");
  refused("name: a\nscenarios: [scenario.yaml]\nplanners: [RRT]\n" + rest + "sweep: {mass: [1]}\n",
          "cannot be varied");
  refused("name: a\nscenarios: [scenario.yaml]\nplanners: [RRT]\n" + rest +
              "sweep: {speed_mps.max: [-1]}\n",
          "speed_mps.max");
  refused(
      "name: a\nscenarios: [scenario.yaml]\nplanners: [{planner: RRT, parameters: {bias: 1}}]\n" +
          rest,
      "parameter bias is not known");
  for (const auto& [value, allowed] :
       {std::pair("goal_bias: 3", "goal_bias: 3 is not valid (allowed: 0 to 1)"),
        std::pair("goal_bias: -5", "goal_bias: -5 is not valid (allowed: 0 to 1)"),
        std::pair("goal_bias: abc", "goal_bias: abc is not valid (allowed: 0 to 1)"),
        std::pair("goal_bias: .nan", "goal_bias: .nan is not valid (allowed: 0 to 1)"),
        std::pair("intermediate_states: 7",
                  "intermediate_states: 7 is not valid (allowed: 0, 1)")}) {
    refused(fmt::format("name: a\nscenarios: [scenario.yaml]\nplanners:\n  - Lattice\n"
                        "  - {{planner: RRT, parameters: {{{}}}}}\n",
                        value) +
                rest,
            fmt::format("suite.yaml:5: planners[1]: RRT: parameter {}", allowed));
    // Before the first run: not even that of the planner before it has left anything.
    EXPECT_FALSE(std::filesystem::exists(folder.path("out/runs.jsonl"))) << value;
  }
  write_suite(folder);
  expect_refused(folder, benchmark_arguments(folder, "out2", "--shard 3/2"), "--shard");
  expect_refused(
      folder, "benchmark merge '" + folder.path("nowhere") + "' --out '" + folder.path("m") + "'",
      "holds no benchmark");
}

TEST(BenchmarkProgram, RefusesAFolderOfAnotherSuite) {
  const ScratchFolder folder;
  write_suite(folder);
  run_until_killed(folder, "out", 3);
  const std::string before = folder.read("out/runs.jsonl");
  std::string suite = folder.read("suite.yaml");
  suite.replace(suite.find("iterations: 60"), 14, "iterations: 61");
  folder.write("suite.yaml", suite);
  expect_refused(folder, benchmark_arguments(folder, "out"), "another time, iteration");
  EXPECT_EQ(folder.read("out/runs.jsonl"), before);
}

TEST(BenchmarkProgram, RefusesAFolderWhoseScenarioHasChanged) {
  const ScratchFolder folder;
  write_flat_scenario(folder);
  const std::string soils = std::string(kOneSoil + 1, std::strlen(kOneSoil) - 2) + "\n";
  const std::string vehicle = run_program(folder, "vehicle lrv").output;
  const auto write_inputs = [&] {
    write_elevation(flat_elevation(), folder.path("dem.tif"));
    folder.write("soils.yaml", soils);
    folder.write("vehicle.yaml", vehicle);
  };
  write_inputs();
  std::string scenario = flat_scenario();
  scenario.replace(scenario.find(kOneSoil), std::strlen(kOneSoil), "soils.yaml");
  scenario.replace(scenario.find("vehicle: lrv"), 12, "vehicle: vehicle.yaml");
  folder.write("scenario.yaml", scenario);
  folder.write("suite.yaml",
               "name: one\nscenarios: [scenario.yaml]\nplanners: [RRT]\nseeds: 1\ntime_s: 30\n"
               "iterations: 60\nsoil_draws: 2\n");
  const std::string arguments = benchmark_arguments(folder, "out", "--quiet");
  ASSERT_EQ(run_program(folder, arguments).status, 0);
  const std::string refusal = "another scenario scenario";

  std::string heavier = vehicle;
  heavier.replace(heavier.find("mass_kg: ") + 9, 1, "6");
  ASSERT_NE(heavier, vehicle);
  folder.write("vehicle.yaml", heavier);
  expect_refused(folder, arguments, refusal);
  write_inputs();
  folder.write("soils.yaml", soils + "classes: {1: mare}\n");
  expect_refused(folder, arguments, refusal);
  folder.write("soils.yaml", soils + "unmapped: mare\n");
  expect_refused(folder, arguments, refusal);
  write_inputs();
  ElevationRaster moved = flat_elevation();
  moved.frame.west_m += 0.25;
  write_elevation(moved, folder.path("dem.tif"));
  expect_refused(folder, arguments, refusal);

  write_inputs();
  EXPECT_EQ(run_program(folder, arguments).status, 0);
  EXPECT_EQ(journal(folder, "out").size(), 1U);
}

TEST(BenchmarkProgram, LosesNothingWhenTheDiskIsFull) {
  const ScratchFolder folder;
  write_suite(folder, 5);
  std::filesystem::create_directories(folder.path("small"));
  if (mount("tmpfs", folder.path("small").c_str(), "tmpfs", 0, "size=24k") != 0) {
    const int error = errno;
    // Only what a machine forbids is its own; whatever else goes wrong, we have caused.
    ASSERT_TRUE(error == EPERM || error == EACCES || error == ENOSYS) << std::strerror(error);
    GTEST_SKIP() << "a small file system cannot be mounted here: " << std::strerror(error);
  }
  const ProgramRun full = run_program(folder, benchmark_arguments(folder, "small/out", "--quiet"));
  EXPECT_EQ(full.status, 1);
  EXPECT_NE(full.errors.find("runs.jsonl: cannot be written (No space left on device)"),
            std::string::npos)
      << full.errors;
  const std::size_t kept = journal(folder, "small/out").size();
  EXPECT_GT(kept, 0U);
  EXPECT_LT(kept, 30U);
  mount("tmpfs", folder.path("small").c_str(), "tmpfs", MS_REMOUNT, "size=8m");
  const ProgramRun rest = run_program(folder, benchmark_arguments(folder, "small/out", "--quiet"));
  EXPECT_EQ(rest.status, 0) << rest.errors;
  EXPECT_EQ(journal(folder, "small/out").size(), 30U);
  umount(folder.path("small").c_str());
}

}  // namespace
}  // namespace regoplan
