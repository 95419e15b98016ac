// `drive` as a person meets it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/app/flat_map.h"
#include "tests/app/program_run.h"

namespace regoplan {
namespace {

class DriveProgram : public testing::Test {
 protected:
  DriveProgram() {
    write_flat_scenario(folder_);
    folder_.write("path.csv", "x_m,y_m,speed_mps\n8,20,0\n14,20,1\n20,20.5,0\n");
  }

  ProgramRun drive(const std::string& arguments, const std::string& out = "out") const {
    return run_program(folder_, "drive '" + folder_.path("scenario.yaml") + "' '" +
                                    folder_.path("path.csv") + "' --out '" + folder_.path(out) +
                                    "' " + arguments);
  }
  nlohmann::json result() const { return nlohmann::json::parse(folder_.read("out/drive.json")); }

  ScratchFolder folder_;
};

TEST_F(DriveProgram, ReachesTheEndAndRecords) {
  const ProgramRun run = drive("--sensors A --follower compensated");
  EXPECT_EQ(run.status, 0) << run.errors << run.output;
  EXPECT_EQ(result()["status"], "reached");
  EXPECT_EQ(result()["follower"], "compensated");
  EXPECT_LT(result()["cross_track_rms_m"], 0.2);
  const std::string recording = folder_.read("out/drive.csv");
  EXPECT_TRUE(recording.starts_with("drive_id,time_s,x_m,y_m,yaw_deg,roll_deg,pitch_deg,"));
  EXPECT_NE(recording.find("torque_front_left_nm"), std::string::npos);
  EXPECT_EQ(recording.find("sinkage_"), std::string::npos);  // grade A does not measure it
  const auto truth = nlohmann::json::parse(folder_.read("out/truth.json"));
  EXPECT_EQ(truth["time_s"].size(), truth["wheels"]["front_left"]["slip"].size());
}

TEST_F(DriveProgram, ThePageOfAnotherCommandInItsFolderIsKeptAndTheUserTold) {
  const ProgramRun judged = run_program(
      folder_, "evaluate '" + folder_.path("scenario.yaml") + "' '" + folder_.path("path.csv") +
                   "' --quiet --out '" + folder_.path("out") + "'");
  ASSERT_EQ(judged.status, 0) << judged.errors;
  const std::string page = folder_.read("out/report.html");
  const ProgramRun run = drive("");
  EXPECT_EQ(run.status, 0) << run.errors;
  EXPECT_NE(run.errors.find("the page of evaluate, kept as evaluate-report.html"),
            std::string::npos)
      << run.errors;
  EXPECT_EQ(folder_.read("out/evaluate-report.html"), page);
  EXPECT_NE(folder_.read("out/report.html"), page);
}

TEST_F(DriveProgram, AFollowerInAnotherProcessIsAskedOverTwoPipes) {
  const std::string script = folder_.write(
      "follow.py",
      "import json, sys\n"
      "for line in sys.stdin:\n"
      "    seen = json.loads(line)\n"
      "    turn = seen['path_curvature_1pm'] - seen['offset_m'] / 9 - seen['heading_error_rad']\n"
      "    told = {'speed_mps': seen['path_speed_mps'], 'curvature_1pm': turn}\n"
      "    print(json.dumps(told), flush=True)\n");
  const std::string shell = fmt::format(
      "cd '{}' && mkfifo seen told && (python3 '{}' <seen >told &) && timeout 60 '{}' drive "
      "scenario.yaml path.csv --quiet --out out --follower-fds 3,4 3>seen 4<told",
      folder_.path(""), script, REGOPLAN_PROGRAM);
  EXPECT_EQ(std::system(("bash -c \"" + shell + "\"").c_str()), 0);
  EXPECT_EQ(result()["status"], "reached");
  EXPECT_EQ(result()["follower"], "own");
}

TEST_F(DriveProgram, WhatIsNoFollowerIsAMistake) {
  expect_refusal(drive("--follower-fds 3"), {"--follower-fds: 3", "OUT,IN"});
  expect_refusal(drive("--follower-fds 98,99"), {"98,99", "open"});
  expect_refusal(drive("--follower pursuit --follower-fds 0,1"), {"--follower"});
  expect_refusal(drive("--quiet --follower-fds 5,6 5>/dev/null 6</dev/null"),
                 {"follower: it has ended without a command"});
  folder_.write("mud.txt", "mud\n");
  expect_refusal(
      drive("--quiet --follower-fds 5,6 5>/dev/null 6<'" + folder_.path("mud.txt") + "'"),
      {"follower: mud is no command"});
}

TEST_F(DriveProgram, TheSameSeedWritesTheSameBytes) {
  ASSERT_EQ(drive("--sensors B --seed 3", "one").status,
            drive("--sensors B --seed 3", "two").status);
  for (const char* file : {"drive.csv", "truth.json", "drive.json", "report.html"}) {
    EXPECT_EQ(folder_.read(std::string("one/") + file), folder_.read(std::string("two/") + file));
  }
}

TEST_F(DriveProgram, StrayingIsANoThatSaysWhere) {
  folder_.write("truth.yaml", "vehicle: {wheels: {front_left: {steer_offset_deg: 20}}}\n");
  const ProgramRun run =
      drive("--deviation-max-m 0.05 --truth '" + folder_.path("truth.yaml") + "'");
  EXPECT_EQ(run.status, 2) << run.errors;
  EXPECT_EQ(result()["status"], "not_reached");
  EXPECT_EQ(result()["reason"], "deviation");
  EXPECT_GT(result()["place"]["s_m"], 0);
}

TEST_F(DriveProgram, TruthFilesAreReadStrictly) {
  const auto refused = [&](const std::string& text, const std::vector<std::string>& words) {
    folder_.write("truth.yaml", text);
    expect_refusal(drive("--truth '" + folder_.path("truth.yaml") + "'"), words);
  };
  refused("mud: 1\n", {"truth.yaml:1", "mud"});
  refused("vehicle: {wheels: {fifth: {drag_nm: 1}}}\n", {"fifth"});
  refused("vehicle:\n  wheels:\n    front_left: {radius_factor: 3}\n",
          {"truth.yaml:3", "radius_factor", "0.5 to 2"});
  refused("zones: [{name: a, like: nowhere, corners_m: [[0, 0], [1, 0], [1, 1]]}]\n", {"nowhere"});
  refused("zones: [{name: a, like: mare, corners_m: [[0, 0], [1, 0]]}]\n",
          {"truth.yaml:1", "2 corners", "at least 3"});
  refused("zones: [{name: a, like: mare, corners_m: [[0, 0], [1, 0], [1e300, 0]]}]\n",
          {"1e300", "-1000000000 to 1000000000"});
  refused("zones:\n- {name: a, like: mare, corners_m: [[1, 1], [2, 2], [4, 4]]}\n",
          {"truth.yaml:2: zones[0].corners_m: the corners lie on one line"});
  refused("soils:\n  mare: {n: {std: 1}}\n", {"truth.yaml:2: soils.mare.n.std", "has no std"});
  refused("mechanisms:\n- {id: slip_sinkage, wheels: [fifth]}\n",
          {"truth.yaml:2: mechanisms[0].wheels[0]: fifth is not valid (allowed: front_left"});
  refused("zones:\n- {name: a, like: mare, corners_m: [[-9, 0], [-8, 0], [-8, 5]]}\n",
          {"truth.yaml:2", "corners_m", "beside the map (x 0 to "});
  refused("ruts: {stiffening: -1}\n", {"stiffening", "0 to 10"});
  EXPECT_FALSE(std::filesystem::exists(folder_.path("out")));
}

TEST_F(DriveProgram, SensorFilesAreReadStrictly) {
  folder_.write("sensors.yaml", "position: {rate_hz: 1, noise_deg: 2}\n");
  expect_refusal(drive("--sensors '" + folder_.path("sensors.yaml") + "'"),
                 {"sensors.yaml:1", "noise_deg"});
  folder_.write("sensors.yaml", "torque: {noise_share: 0.1}\n");
  expect_refusal(drive("--sensors '" + folder_.path("sensors.yaml") + "'"), {"rate_hz"});
  expect_refusal(drive("--sensors C"), {"--sensors: C", "A | B"});
}

TEST_F(DriveProgram, WhatIsNoVehicleAnyMoreIsAMistakeInTheTruth) {
  folder_.write("truth.yaml", "vehicle: {cg_left_m: 5}\n");
  expect_refusal(drive("--truth '" + folder_.path("truth.yaml") + "'"),
                 {"truth.yaml:1: vehicle.cg_left_m: 5 is not valid", "centre of gravity"});
  folder_.write("truth.yaml", "vehicle:\n  payload_kg: 10\n  cg_up_m: -90\n");
  expect_refusal(drive("--truth '" + folder_.path("truth.yaml") + "'"),
                 {"truth.yaml:", "cg_height_m: -8"});
}

TEST_F(DriveProgram, ATruthComesThroughAPipeToo) {
  const std::string shell = fmt::format(
      "bash -c \"timeout 20 '{}' drive '{}' '{}' --quiet --out '{}' --truth <(echo "
      "'ruts: {{stiffening: 1}}')\"",
      REGOPLAN_PROGRAM, folder_.path("scenario.yaml"), folder_.path("path.csv"),
      folder_.path("out"));
  EXPECT_EQ(std::system(shell.c_str()), 0);
  const auto truth = nlohmann::json::parse(folder_.read("out/truth.json"));
  EXPECT_EQ(truth["truth"], "ruts: {stiffening: 1}\n");
}

TEST_F(DriveProgram, NothingIsLeftOfAMistakeAndNothingOfOthersIsReplaced) {
  expect_refusal(drive("--seed -1"), {"--seed: -1"});
  expect_refusal(drive("--deviation-max-m 0"), {"--deviation-max-m: 0"});
  EXPECT_FALSE(std::filesystem::exists(folder_.path("out")));
  std::filesystem::create_directory(folder_.path("out"));
  folder_.write("out/report.html", "mine");
  expect_refusal(drive(""), {"report.html: ", "--force"});
  EXPECT_EQ(folder_.read("out/report.html"), "mine");
}

TEST(TruthFile, NoOtherCommandOpensIt) {
  const std::filesystem::path root = REGOPLAN_SOURCE_DIR;
  for (const char* house : {"app", "planner", "driving", "diagnosis", "benchmarking", "maps"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / house)) {
      const std::filesystem::path& file = entry.path();
      if (file.extension() != ".cpp" && file.extension() != ".h") continue;
      if (file.parent_path() == root / "app/drive") continue;
      std::ifstream stream(file);
      const std::string text{std::istreambuf_iterator<char>(stream), {}};
      EXPECT_EQ(text.find("truth.json"), std::string::npos) << file;
    }
  }
}

}  // namespace
}  // namespace regoplan
