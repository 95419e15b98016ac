// Results say what was asked, and two of them whether it was the same.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>

#include "app/benchmark/benchmark_files.h"
#include "app/compare/comparison.h"
#include "tests/app/flat_map.h"
#include "tests/app/program_run.h"
#include "tests/app/simulant_model.h"
#include "tests/benchmarking/made_up_runs.h"
#include "tests/error_text.h"

namespace regoplan {
namespace {

using Told = std::vector<std::string>;

/// A suite's results as its folder holds them.
ComparedResult benchmark_result(const ScratchFolder& folder, const JournalOrigin& origin,
                                int seeds = 2) {
  JournalContents journal{.origins = {origin}, .runs = {}};
  for (int seed = 1; seed <= seeds; ++seed) {
    journal.runs.push_back(verified_run("a", "RRT", static_cast<std::uint64_t>(seed), 1.5, 30));
  }
  folder.write("benchmark.json", benchmark_json({.journal = journal}));
  return read_compared_result(folder.path("benchmark.json"));
}

Told keys_of(const Comparison& comparison) {
  Told keys;
  for (const ComparedSetting& setting : comparison.settings) keys.push_back(setting.key);
  return keys;
}

TEST(ComparedSettings, OfSuitesAreAllThatBoundsAndMakesTheirRuns) {
  using Change = std::function<void(JournalOrigin&)>;
  const std::vector<std::pair<std::string, Change>> changes{
      {"suite", [](JournalOrigin& o) { o.suite = "another"; }},
      {"time_s", [](JournalOrigin& o) { o.bounds.time_s = 3; }},
      {"iterations", [](JournalOrigin& o) { o.bounds.iterations = 500; }},
      {"memory_mb", [](JournalOrigin& o) { o.bounds.memory_mb = 600; }},
      {"progress_interval_s", [](JournalOrigin& o) { o.bounds.progress_interval_s = 0.1; }},
      {"soil_draws", [](JournalOrigin& o) { o.bounds.soil_draws = 20; }},
      {"planners.RRT.planner", [](JournalOrigin& o) { o.planners[0].planner = "EST"; }},
      {"planners.RRT.parameters.goal_bias",
       [](JournalOrigin& o) { o.planners[0].parameters["goal_bias"] = "0.3"; }},
      {"version", [](JournalOrigin& o) { o.version = "2"; }}};
  const ScratchFolder folder;
  const ComparedResult before = benchmark_result(folder, made_up_origin());
  EXPECT_EQ(keys_of(compared(before, before)), Told{});
  for (const auto& [key, change] : changes) {
    JournalOrigin origin = made_up_origin();
    change(origin);
    EXPECT_EQ(keys_of(compared(before, benchmark_result(folder, origin))), Told{key});
  }
  EXPECT_EQ(keys_of(compared(before, benchmark_result(folder, made_up_origin(), 3))),
            Told{"seeds"});
  JournalOrigin origin = made_up_origin();
  origin.scenarios["a"] = "33";
  EXPECT_EQ(compared(before, benchmark_result(folder, origin)).inputs, Told{"scenario a"});
}

/// The same path judged in two ways.
class ComparedEvaluations : public testing::Test {
 protected:
  ComparedEvaluations() {
    write_flat_scenario(folder_);
    folder_.write("path.csv", "x_m,y_m\n8,20\n20,20.5\n");
    folder_.write("model.yaml", replaced(kSimulantModel, "soil_name: simulant", "soil_name: mare"));
    folder_.write("turn.yaml", "- {kind: point_turn, angle_deg: 20, vehicle: curiosity}\n");
  }

  ComparedResult judged(const std::string& options) const {
    const ProgramRun run =
        run_program(folder_, fmt::format("evaluate '{}' '{}' --quiet --force --out '{}' {}",
                                         folder_.path("scenario.yaml"), folder_.path("path.csv"),
                                         folder_.path("out"), options));
    EXPECT_NE(run.status, 1) << options << run.errors;
    return read_compared_result(folder_.path("out"));
  }

  const ScratchFolder folder_;
};

TEST_F(ComparedEvaluations, TellEveryOptionThatChangesAJudgement) {
  const std::string few = "--draws 10 ";
  const ComparedResult before = judged(few);
  EXPECT_EQ(keys_of(compared(before, judged(few))), Told{});
  EXPECT_EQ(compared(before, judged(few)).inputs, Told{});
  for (const auto& [key, options] : std::vector<std::pair<std::string, std::string>>{
           {"speed_mps.max", few + "--speed 0.5"},
           {"deviation_max_m", few + "--deviation-max-m 0.3"},
           {"follower", few + "--follower pursuit"},
           {"soil_draws", "--draws 12"},
           {"seed", few + "--seed 9"}}) {
    EXPECT_EQ(keys_of(compared(before, judged(options))), Told{key}) << options;
  }
  const std::string model = fmt::format("{}--model '{}'", few, folder_.path("model.yaml"));
  EXPECT_EQ(compared(before, judged(model)).inputs, Told{"model"});
  const std::string turn = fmt::format("{}--manoeuvres '{}'", few, folder_.path("turn.yaml"));
  const ComparedResult turned = judged(turn);
  EXPECT_EQ(compared(before, turned).inputs, Told{"manoeuvres"});
  EXPECT_EQ(turned.asked.at("manoeuvre_vehicles").at("curiosity").at("name"), "curiosity");
  folder_.write("path.csv", "x_m,y_m\n8,20\n20,20.6\n");
  EXPECT_EQ(compared(before, judged(few)).inputs, Told{"path path.csv"});
}

/// A planner of which so many runs were verified, by A and by B, and what is said of B.
std::string said_of_shares(const ScratchFolder& folder, std::array<int, 2> a,
                           std::array<int, 2> b) {
  const auto read = [&](std::array<int, 2> verified_of) {
    JournalContents journal{.origins = {made_up_origin()}, .runs = {}};
    for (int seed = 1; seed <= verified_of[1]; ++seed) {
      RunRecord run = verified_run("a", "RRT", static_cast<std::uint64_t>(seed), 1.5, 30);
      if (seed > verified_of[0]) run.outcome.properties["verified BOOLEAN"] = "0";
      journal.runs.push_back(run);
    }
    folder.write("benchmark.json", benchmark_json({.journal = journal}));
    return read_compared_result(folder.path("benchmark.json"));
  };
  const ComparedResult of_a = read(a), of_b = read(b);
  const std::string headline = comparison_headline(of_a, of_b, compared(of_a, of_b));
  return headline.substr(0, headline.find(" for 1 "));
}

TEST(ComparedSettings, PlannersAreHeldAgainstEachOtherByTheShareOfTheirRunsAndNotByTheirCount) {
  const ScratchFolder folder;
  const std::string of = "Of 1 in both, B is ";
  EXPECT_EQ(said_of_shares(folder, {2, 2}, {7, 7}), of + "the same");
  EXPECT_EQ(said_of_shares(folder, {2, 2}, {7, 8}), of + "tied within the runs");
  EXPECT_EQ(said_of_shares(folder, {2, 2}, {0, 2}), of + "tied within the runs");
  EXPECT_EQ(said_of_shares(folder, {2, 40}, {3, 60}), of + "the same");
  EXPECT_EQ(said_of_shares(folder, {19, 20}, {30, 60}), of + "worse");
  EXPECT_EQ(said_of_shares(folder, {30, 60}, {19, 20}), of + "better");
}

TEST(ComparedSettings, OfAResultThatTellsNoneAreNotTakenToBeTheSame) {
  const ScratchFolder folder;
  nlohmann::json json = nlohmann::json::parse(
      benchmark_json({.journal = {.origins = {made_up_origin()}, .runs = {}}}));
  json.erase("settings");
  folder.write("benchmark.json", json.dump());
  EXPECT_THROW(read_compared_result(folder.path("benchmark.json")), InputError);
}

}  // namespace
}  // namespace regoplan
