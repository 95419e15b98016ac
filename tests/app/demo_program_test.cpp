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

/// Where the whole demo goes: the tests of its pages look at it too (cmake/long_tests.cmake).
std::string demo_folder(const ScratchFolder& folder) {
  const char* kept = std::getenv("REGOPLAN_DEMO_FOLDER");
  if (!kept) return folder.path("out");
  std::filesystem::remove_all(kept);
  return kept;
}

nlohmann::json read_json(const std::string& path) {
  return nlohmann::json::parse(std::ifstream(path));
}

TEST(DemoProgram, APatchThatNobodyWasToldOfBreaksLimitsIsFoundAndIsAvoided) {
  const ScratchFolder folder;
  const std::string out = demo_folder(folder);
  // Each run of the planner then reaches far enough to go round the patch, whatever the seed.
  const ProgramRun run = run_demo(folder, "--iterations 2000 --candidates 3", out);
  ASSERT_EQ(run.status, 0) << run.errors;
  EXPECT_TRUE(run.output.ends_with("report: " + out + "/report.html\n"));

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
  const ProgramRun run = run_demo(
      folder, "--no-drive --planner Lattice --iterations 600 --candidates 1", folder.path("out"));
  EXPECT_EQ(run.status, 0) << run.errors;
  EXPECT_TRUE(std::filesystem::exists(folder.path("out/plan.json")));
  EXPECT_FALSE(std::filesystem::exists(folder.path("out/drive")));
}

}  // namespace
}  // namespace regoplan
