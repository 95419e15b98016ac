// A plan is repeated from its plan.json alone, and what has changed since is said.
#include <gtest/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "tests/app/flat_map.h"
#include "tests/app/program_run.h"

namespace regoplan {
namespace {

using Json = nlohmann::json;

/// Each test goes on from a plan of its own folder, which was made once.
class PlanAgain : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    planned_ = std::make_unique<ScratchFolder>();
    write_flat_scenario(*planned_);
    const ProgramRun run =
        run_program(*planned_, "plan '" + planned_->path("scenario.yaml") +
                                   "' --planner RRT --seed 3 --candidates 1 --out '" +
                                   planned_->path("first") + "'");
    ASSERT_EQ(run.status, 0) << run.errors;
  }
  static void TearDownTestSuite() { planned_.reset(); }
  PlanAgain() { folder_.copy_from(*planned_); }

  std::string quoted(const std::string& name) { return " '" + folder_.path(name) + "' "; }
  ProgramRun plan(const std::string& arguments, const std::string& out) {
    return run_program(folder_, "plan " + arguments + " --out" + quoted(out));
  }
  ProgramRun again(const std::string& more = "") {
    return plan("--again" + quoted("first/plan.json") + more, "again");
  }
  Json json(const std::string& out) { return Json::parse(folder_.read(out + "/plan.json")); }

  static inline std::unique_ptr<ScratchFolder> planned_;
  ScratchFolder folder_;
};

TEST_F(PlanAgain, RepeatsItToTheBit) {
  const ProgramRun run = again();
  EXPECT_EQ(run.status, 0) << run.errors;
  EXPECT_NE(run.errors.find("its inputs are as they were"), std::string::npos) << run.errors;
  EXPECT_EQ(folder_.read("again/candidate-1.csv"), folder_.read("first/candidate-1.csv"));
  EXPECT_EQ(json("again")["settings"], json("first")["settings"]);
  EXPECT_EQ(json("again")["again"], (Json{{"file", "../first/plan.json"},
                                          {"changed", Json::array()},
                                          {"same_candidates", true}}));
  EXPECT_EQ(json("first")["again"], nullptr);
}

TEST_F(PlanAgain, FilesAreToldAsSeenFromAFolderThatIsYetToBeMade) {
  const ProgramRun run = run_program(folder_, "plan --again first/plan.json --out yet/to/be/made",
                                     "cd" + quoted("") + "&& ");
  EXPECT_EQ(run.status, 0) << run.errors;
  const Json found = json("yet/to/be/made");
  EXPECT_EQ(found["inputs"][0]["file"], "../../../../scenario.yaml");
  EXPECT_EQ(found["again"]["file"], "../../../../first/plan.json");
}

TEST_F(PlanAgain, NamesEachInputWithADigest) {
  const Json inputs = json("first")["inputs"];
  ASSERT_EQ(inputs.size(), 2U);
  EXPECT_EQ(inputs[0]["key"], "scenario");
  EXPECT_EQ(inputs[0]["file"], "../scenario.yaml");
  EXPECT_EQ(inputs[1]["key"], "map.elevation");
  EXPECT_EQ(inputs[1]["file"], "../dem.tif");
  EXPECT_EQ(inputs[1]["digest"].get<std::string>().size(), 16U);
  EXPECT_NE(inputs[0]["digest"], inputs[1]["digest"]);
}

TEST_F(PlanAgain, KeepsANameWithAVariableAsItWasWritten) {
  std::string scenario = flat_scenario();
  scenario.replace(scenario.find("dem.tif"), 7, "${REGOPLAN_TEST_FOLDER}/dem.tif");
  folder_.write("named.yaml", scenario);
  const std::string set = "REGOPLAN_TEST_FOLDER='" + folder_.path("") + "' ";
  const ProgramRun run = run_program(
      folder_, "plan" + quoted("named.yaml") + "--candidates 1 --out" + quoted("named"), set);
  ASSERT_EQ(run.status, 0) << run.errors;
  const Json inputs = json("named")["inputs"];
  EXPECT_EQ(inputs[0]["file"], "../named.yaml");
  EXPECT_EQ(inputs[1]["file"], "${REGOPLAN_TEST_FOLDER}/dem.tif");
  EXPECT_EQ(inputs[1]["digest"], json("first")["inputs"][1]["digest"]);
}

TEST_F(PlanAgain, SaysWhichInputChanged) {
  ElevationRaster raised = flat_elevation();
  raised.height_m[0] = 0.25F;
  write_elevation(raised, folder_.path("dem.tif"));
  const ProgramRun run = again();
  EXPECT_EQ(run.status, 0) << run.errors;
  EXPECT_NE(run.errors.find("changed since then: map.elevation"), std::string::npos) << run.errors;
  EXPECT_EQ(json("again")["again"]["changed"], Json::array({"map.elevation"}));
}

TEST_F(PlanAgain, TakesWhatStandsOnTheCommandLineFirst) {
  ASSERT_EQ(again("--seed 4").status, 0);
  EXPECT_EQ(json("again")["seed"], 4);
  EXPECT_EQ(json("again")["planner"], "RRT");
  EXPECT_EQ(json("again")["again"]["same_candidates"], false);
}

TEST_F(PlanAgain, IsRefusedWhereNothingSaysHowItCameAbout) {
  folder_.write("other.json", "{\"status\": \"feasible\"}");
  expect_refusal(plan("--again" + quoted("other.json"), "again"),
                 {"other.json: is no plan.json that says how it came about"});
  expect_refusal(plan("--again" + quoted("absent.json"), "again"), {"absent.json: no such file"});
  expect_refusal(plan("", "again"), {"one of SCENARIO.yaml and --again PLAN.json is needed"});
  expect_refusal(plan(quoted("scenario.yaml") + "--again" + quoted("first/plan.json"), "again"),
                 {"one of SCENARIO.yaml and --again PLAN.json is needed"});
}

}  // namespace
}  // namespace regoplan
