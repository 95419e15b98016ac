// `demo` as a person meets it: plan, drive, diagnosis, plan again.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/app/json_schema.h"
#include "tests/app/program_run.h"

namespace regoplan {
namespace {

/// A bounded demo: the same on every machine.
ProgramRun run_demo(const ScratchFolder& folder, const std::string& options,
                    const std::string& out) {
  return run_program(folder, "demo " + options + " --out '" + out + "'");
}

/// Where a demo goes: the tests of its pages look at it too (cmake/long_tests.cmake).
std::string demo_folder(const ScratchFolder& folder, const std::string& name) {
  const char* kept = std::getenv("REGOPLAN_DEMO_FOLDER");
  if (!kept) return folder.path(name);
  const std::filesystem::path demo = std::filesystem::path(kept) / name;
  std::filesystem::remove_all(demo);
  return demo;
}

nlohmann::json read_json(const std::string& path) {
  return nlohmann::json::parse(std::ifstream(path));
}

/// What the plan shows, as a promise: the physics decides, not a tuned constant.
void expect_physics_decides(const nlohmann::json& plan) {
  ASSERT_EQ(plan["status"], "feasible") << plan["reason"];
  const auto& candidates = plan["candidates"];
  ASSERT_GE(candidates.size(), 3u);
  for (const auto& candidate : candidates) {
    EXPECT_GE(candidate["verified"]["margin_min"], plan["limits"]["margin_min"]);
  }
  for (std::size_t i = 1; i < candidates.size(); ++i) {
    // Who ranks lower is no better than the sampling error of who ranks higher.
    EXPECT_GE(candidates[i - 1]["margin_p05_ci95"][1], candidates[i]["margin_p05"]);
  }
  EXPECT_GT(plan["rejected"]["cornering"], 0);
  ASSERT_EQ(plan["what_ifs"].size(), 3u);
  const auto& twice_as_fast = plan["what_ifs"][0];
  EXPECT_EQ(twice_as_fast["feasible"], false);
  EXPECT_EQ(twice_as_fast["rejected"], "cornering");
  const auto& same_controls_on_weaker_soil = plan["what_ifs"][2];
  EXPECT_GT(same_controls_on_weaker_soil.at("end_shift_m"), 1);
}

TEST(DemoProgram, ThePhysicsDecidesAndAPatchThatNobodyWasToldOfBreaksLimitsIsFoundAndIsAvoided) {
  const ScratchFolder folder;
  const std::string out = demo_folder(folder, "whole");
  // Each run of the planner then reaches far enough to go round the patch, whatever the seed.
  const ProgramRun run = run_demo(folder, "--iterations 2000 --candidates 3", out);
  ASSERT_EQ(run.status, 0) << run.errors;
  EXPECT_TRUE(run.output.ends_with("report: " + out + "/report.html\n"));
  expect_physics_decides(read_json(out + "/plan.json"));

  const auto loop = read_json(out + "/drive/loop.json");
  EXPECT_EQ(schema("loop").errors(loop), std::vector<std::string>());
  EXPECT_EQ(loop["first_drive"]["status"], "limits_broken");
  ASSERT_EQ(loop["diagnosis"]["zones"].size(), 1u) << loop["diagnosis"];
  const auto& track = loop["diagnosis"]["zones"][0];
  const double x_m = loop["hidden_patch"]["x_m"], y_m = loop["hidden_patch"]["y_m"];
  constexpr double kWindow_m = 15;  // of 5 s at 3 m/s
  for (const auto& place : track) {
    const double away_m = std::hypot(place[0].get<double>() - x_m, place[1].get<double>() - y_m);
    EXPECT_LT(away_m, loop["hidden_patch"]["radius_m"].get<double>() + kWindow_m);
  }
  EXPECT_TRUE(loop["verdicts"][0]["before"]["holds"]);
  EXPECT_FALSE(loop["verdicts"][0]["after"]["holds"]);
  EXPECT_EQ(loop["second_drive"]["status"], "reached");
  for (const char* file : {"/drive/report.html", "/drive/drive.csv", "/drive/diagnosis.json",
                           "/drive/corrected-map/scenario.yaml", "/drive/again/plan.json"}) {
    EXPECT_TRUE(std::filesystem::exists(out + file)) << file;
  }
  // Its files are what the commands read: the same drive gives the same diagnosis.
  const std::string drive = out + "/drive";
  const ProgramRun by_hand = run_program(
      folder, "diagnose '" + drive + "/drive.csv' --scenario '" + drive +
                  "/map/scenario.yaml' --json --quiet --out '" + folder.path("said") + "'");
  ASSERT_EQ(by_hand.status, 0) << by_hand.errors;
  const auto own = read_json(out + "/drive/diagnosis.json");
  EXPECT_EQ(nlohmann::json::parse(by_hand.output)["zones"], own["zones"]);
}

TEST(DemoProgram, WithoutADriveItPlansAlone) {
  const ScratchFolder folder;
  const std::string out = demo_folder(folder, "plan-alone");
  const ProgramRun run = run_demo(
      folder, "--no-drive --planner Lattice --iterations 500 --candidates 2 --seed 4", out);
  EXPECT_EQ(run.status, 0) << run.errors;
  EXPECT_TRUE(std::filesystem::exists(out + "/plan.json"));
  EXPECT_FALSE(std::filesystem::exists(out + "/drive"));
}

}  // namespace
}  // namespace regoplan
