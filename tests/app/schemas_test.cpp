// What the program writes is what docs/schemas say of it: no key beside them, none missing, each of
// its type. From the writers themselves, given something of everything, and from runs.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "app/benchmark/benchmark_files.h"
#include "app/diagnose/diagnosis_files.h"
#include "app/evaluate/evaluation_files.h"
#include "app/plan/plan_files.h"
#include "tests/app/diagnosis_fixture.h"
#include "tests/app/drive_fixture.h"
#include "tests/app/flat_map.h"
#include "tests/app/json_schema.h"
#include "tests/app/plan_report_fixture.h"
#include "tests/app/program_run.h"
#include "tests/benchmarking/made_up_runs.h"

namespace regoplan {
namespace {

using Json = nlohmann::json;

void expect_kept(const std::string& name, const std::string& text) {
  EXPECT_EQ(schema(name).errors(Json::parse(text)), std::vector<std::string>());
}

TEST(Schemas, HoldWhatTheWritersWriteOfEverything) {
  const PlanningProblem problem = report_test_problem(report_test_map(40));
  expect_kept("plan", plan_json(problem, report_test_result(problem)));

  PathEvaluation evaluation{.name = "path", .refusal = Refusal{.reason = Rejection::kSlope}};
  evaluation.rank = 1;
  evaluation.cornering_limit = CorneringLimit{.wheel = "front_left", .fold_n = 1};
  evaluation.spread = SoilSpread{.influences = {{.soil = "mare", .parameter = "kphi"}}};
  const EvaluatedPath given{.evaluation = evaluation, .recorded_margin_min = 0.5};
  const EvaluatedPath manoeuvre{
      .evaluation = evaluation, .plane = ManoeuvrePlane{}, .recorded_margin_min = {}};
  const EvaluatedPath without_margins{
      .evaluation = {.name = "sharp",
                     .rank = 2,
                     .refusal = Refusal{.reason = Rejection::kSteering}},
      .recorded_margin_min = 0.5};
  expect_kept("evaluation", evaluation_json(problem, {.paths = {given, manoeuvre, without_margins},
                                                      .settings = {}}));

  const DriveRecord driven = made_up_drive(problem, 20);
  expect_kept("drive", drive_json(driven, problem));
  expect_kept("truth", truth_json(driven, TrueWorld(problem, {})));

  expect_kept("diagnosis", diagnosis_json(claimed_diagnosis()));
  expect_kept("diagnosis", diagnosis_json(consistent_diagnosis()));
  expect_kept("diagnosis", diagnosis_json(unexplained_diagnosis()));
  const std::string undecided = diagnosis_json(interrupted_diagnosis());
  EXPECT_EQ(Json::parse(undecided).at("verdict"), "undecided");
  expect_kept("diagnosis", undecided);

  JournalContents journal{.origins = {made_up_origin()}, .runs = {}};
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    for (const char* planner : {"RRT", "SST"}) {
      journal.runs.push_back(verified_run("a", planner, seed, 1.5, 30));
    }
  }
  expect_kept("benchmark", benchmark_json({.journal = journal}));
}

TEST(Schemas, HoldWhatRunsWrite) {
  const ScratchFolder folder;
  const std::string scenario = write_flat_scenario(folder);
  const std::string suite = folder.write("suite.yaml",
                                         "name: s\nscenarios: [scenario.yaml]\nplanners: "
                                         "[RRT]\nseeds: 1\ntime_s: 9\niterations: 60\n");
  const auto run = [&](const std::string& command, const std::string& input) {
    return run_program(
        folder, fmt::format("{} '{}' --out '{}' --quiet", command, input, folder.path("out")));
  };
  ASSERT_EQ(run("plan --iterations 200 --candidates 1", scenario).status, 0);
  expect_kept("plan", folder.read("out/plan.json"));
  const ProgramRun map = run_program(
      folder, fmt::format("map info --json '{}' '{}'", scenario, folder.path("dem.tif")));
  ASSERT_EQ(map.status, 0) << map.errors;
  expect_kept("map", map.output);
  const std::string found = folder.path("out/candidate-1.csv");
  const ProgramRun judged = run("evaluate '" + scenario + "'", found);
  ASSERT_EQ(judged.status, 0) << judged.errors;
  expect_kept("evaluation", folder.read("out/evaluation.json"));
  ASSERT_NE(run("drive --sensors B '" + scenario + "'", found).status, 1);
  expect_kept("drive", folder.read("out/drive.json"));
  expect_kept("truth", folder.read("out/truth.json"));
  ASSERT_EQ(run("plan --again", folder.path("out/plan.json")).status, 0);
  expect_kept("plan", folder.read("out/plan.json"));
  ASSERT_EQ(run("benchmark", suite).status, 0);
  expect_kept("benchmark", folder.read("out/benchmark.json"));
}

TEST(Schemas, RefuseWhatDoesNotKeepThem) {
  const PlanningProblem problem = report_test_problem(report_test_map(40));
  const Json good = Json::parse(plan_json(problem, report_test_result(problem)));
  const auto errors = [&](const std::function<void(Json&)>& spoil) {
    Json bad = good;
    spoil(bad);
    return schema("plan").errors(bad).size();
  };
  EXPECT_EQ(errors([](Json&) {}), 0U);
  EXPECT_EQ(errors([](Json& plan) { plan["status"] = "maybe"; }), 1U);
  EXPECT_EQ(errors([](Json& plan) { plan["another"] = 1; }), 1U);
  EXPECT_EQ(errors([](Json& plan) { plan.erase("settings"); }), 1U);
  EXPECT_EQ(errors([](Json& plan) { plan["rejected"]["slope"] = "many"; }), 1U);
  EXPECT_EQ(errors([](Json& plan) { plan["candidates"][0]["length_m"] = -1; }), 1U);
}

}  // namespace
}  // namespace regoplan
