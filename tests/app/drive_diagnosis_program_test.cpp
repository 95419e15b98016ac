// `diagnose` of a drive, and what it hands back, as a person meets them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "terramech/tables/csv_cells.h"
#include "tests/app/browser_page.h"
#include "tests/app/json_schema.h"
#include "tests/app/program_run.h"
#include "tests/scratch_folder.h"

namespace regoplan {
namespace {

/// A drive with its second column, the time, told in ms.
std::string in_milliseconds(const std::string& drive) {
  std::istringstream text(drive);
  std::string line, told;
  std::getline(text, told);
  told += "\n";
  while (std::getline(text, line)) {
    std::vector<std::string> cells = *split_cells(line);
    cells.at(1) = fmt::format("{}", 1000 * std::stod(cells.at(1)));
    told += fmt::format("{}\n", fmt::join(cells, ","));
  }
  return told;
}

class DriveDiagnosisProgram : public testing::Test {
 protected:
  DriveDiagnosisProgram() {
    folder_.write("s.yaml",
                  "map:\n  soils: " REGOPLAN_SOURCE_DIR
                  "/scenarios/demo/soils.yaml\n"
                  "  terrain: {width_m: 220, height_m: 60, roughness_m: 0.03}\n"
                  "vehicle: lrv\ngravity_mps2: 1.62\n"
                  "start: {x_m: 20, y_m: 30, heading_deg: 0}\n"
                  "goal: {x_m: 190, y_m: 30, radius_m: 3}\n"
                  "planner: {name: Lattice, iterations: 400, candidates: 1, soil_draws: 10}\n");
    std::string path = "x_m,y_m,speed_mps\n";
    for (int x = 20; x <= 190; x += 5) {
      path += std::to_string(x) + "," + std::to_string(30 + (x / 20) % 2) +
              (x == 20 ? ",0\n" : ",1.2\n");
    }
    folder_.write("p.csv", path);
  }

  ProgramRun run(const std::string& arguments) const { return run_program(folder_, arguments); }
  nlohmann::json diagnosis() const {
    return nlohmann::json::parse(folder_.read("said/diagnosis.json"));
  }

  /// Of the difference between two columns of windows.csv, where both have values.
  double root_mean_square(const std::string& column, const std::string& other) const {
    std::istringstream text(folder_.read("said/windows.csv"));
    std::string line;
    std::getline(text, line);
    const std::vector<std::string> names = *split_cells(line);
    const auto place = [&names](const std::string& name) {
      return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
    };
    double squares = 0;
    int count = 0;
    while (std::getline(text, line)) {
      const std::vector<std::string> cells = *split_cells(line);
      const std::string &a = cells.at(place(column)), &b = cells.at(place(other));
      if (a.empty() || b.empty()) continue;
      squares += std::pow(std::stod(a) - std::stod(b), 2);
      ++count;
    }
    return std::sqrt(squares / count);
  }

  ScratchFolder folder_;
};

TEST_F(DriveDiagnosisProgram, AHiddenSoftPatchIsFoundAndThePlanGoesOnWithIt) {
  folder_.write("t.yaml",
                "zones:\n  - {name: patch, like: soft_patch, corners_m: [[90, 0], [120, 0], "
                "[120, 60], [90, 60]]}\n");
  const std::string s = folder_.path("s.yaml"), out = folder_.path("said");
  run("drive '" + s + "' '" + folder_.path("p.csv") + "' --truth '" + folder_.path("t.yaml") +
      "' --sensors A --deviation-max-m 5 --out '" + folder_.path("driven") + "'");
  const ProgramRun said = run("diagnose '" + folder_.path("driven/drive.csv") + "' --scenario '" +
                              s + "' --out '" + out + "'");
  ASSERT_EQ(said.status, 0) << said.errors;
  EXPECT_EQ(schema("drive-diagnosis").errors(diagnosis()), std::vector<std::string>());
  for (const nlohmann::json& silent : diagnosis()["not_shown"]) {
    for (const std::string id : silent["ids"]) {
      EXPECT_EQ(run("mechanisms " + id).status, 0) << id << ": no name that `mechanisms` knows";
    }
  }
  const nlohmann::json zones = diagnosis()["zones"];
  ASSERT_EQ(zones.size(), 1u) << diagnosis()["mechanisms"];
  EXPECT_EQ(zones[0]["map_soil"], "firm_regolith");
  const auto& track = zones[0]["track"];
  constexpr double kWindow_m = 7;  // of 5 s
  EXPECT_NEAR(track.front()[0], 90, kWindow_m);
  EXPECT_NEAR(track.back()[0], 120, kWindow_m);
  EXPECT_GT(zones[0]["resistance_share"]["value"], 0);
  EXPECT_LT(zones[0]["soil"]["kphi"]["mean"], zones[0]["soil_of_map"]["kphi"]["mean"]);
  for (const auto& [channel, fit] : diagnosis()["fit"].items()) {
    EXPECT_NEAR(root_mean_square("measured_" + channel, "model_" + channel), fit["baseline_rmse"],
                1e-6);
    EXPECT_NEAR(root_mean_square("measured_" + channel, "corrected_" + channel),
                fit["corrected_rmse"], 1e-6);
  }

  const std::string drive = "'" + folder_.path("driven/drive.csv") + "'";
  const ProgramRun twice = run("diagnose " + drive + " " + drive + " --scenario '" + s +
                               "' --out '" + folder_.path("twice") + "'");
  EXPECT_EQ(twice.status, 1);
  EXPECT_NE(twice.errors.find("the same drive as"), std::string::npos) << twice.errors;

  const std::string corrected = folder_.path("said/corrected-map/scenario.yaml");
  const ProgramRun again = run("plan '" + corrected + "' --out '" + folder_.path("second") + "'");
  EXPECT_EQ(again.status, 0) << again.errors;
  const auto plan = nlohmann::json::parse(folder_.read("second/plan.json"));
  EXPECT_EQ(plan["status"], "feasible");

  // what another drive does not tell is not left there from this one
  folder_.write("ms.csv", in_milliseconds(folder_.read("driven/drive.csv")));
  const ProgramRun doubtful =
      run("diagnose '" + folder_.path("ms.csv") + "' --scenario '" + s + "' --out '" + out + "'");
  EXPECT_EQ(doubtful.status, 2) << doubtful.errors;
  EXPECT_EQ(diagnosis()["verdict"], "undecided");
  EXPECT_FALSE(std::filesystem::exists(corrected));
}

TEST_F(DriveDiagnosisProgram, AFaultOfASlowRoverIsNamed) {
  std::string scenario = folder_.read("s.yaml");
  scenario.replace(scenario.find("lrv"), 3, "curiosity");
  const std::string s = folder_.write("slow.yaml", scenario);
  std::string path = "x_m,y_m,speed_mps\n";
  for (int x = 20; x <= 60; ++x)
    path += fmt::format("{},{},0.04\n", x, 30 + 0.5 * std::sin(x / 5.));
  folder_.write("slow.csv", path);
  folder_.write("drag.yaml", "vehicle: {wheels: {front_left: {drag_nm: 8}}}\n");
  run("drive '" + s + "' '" + folder_.path("slow.csv") + "' --truth '" + folder_.path("drag.yaml") +
      "' --sensors A --deviation-max-m 5 --out '" + folder_.path("driven") + "'");
  const ProgramRun said = run("diagnose '" + folder_.path("driven/drive.csv") + "' --scenario '" +
                              s + "' --out '" + folder_.path("said") + "'");
  ASSERT_EQ(said.status, 0) << said.errors << said.output;
  EXPECT_EQ(diagnosis()["windows_used"]["left_out"]["too_many"], 0);
  ASSERT_EQ(diagnosis()["mechanisms"].size(), 1u) << said.output;
  const nlohmann::json drag = diagnosis()["mechanisms"][0];
  EXPECT_EQ(drag["id"], "wheel_drag");
  EXPECT_NEAR(drag["parameters"]["drag_front_left_nm"]["value"], 8, 1.5) << drag;
}

TEST_F(DriveDiagnosisProgram, ADriveThatStandsIsToldToGoOn) {
  std::string standing = "time_s,x_m,y_m,yaw_deg";
  for (const char* wheel : {"front_left", "front_right", "rear_left", "rear_right"}) {
    standing += fmt::format(",wheel_speed_{0}_rad_s,steer_{0}_deg", wheel);
  }
  for (int i = 0; i < 200; ++i)
    standing += fmt::format("\n{},{},30,0,0,0,0,0,0,0,0,0", i, 20 + i % 2);
  const ProgramRun said =
      run("diagnose '" + folder_.write("stands.csv", standing + "\n") + "' --scenario '" +
          folder_.path("s.yaml") + "' --out '" + folder_.path("said") + "'");
  EXPECT_EQ(said.status, 2) << said.errors;
  EXPECT_NE(said.output.find("on the map without a stop, all wheels turning one way and faster "),
            std::string::npos)
      << said.output;
}

TEST_F(DriveDiagnosisProgram, ColumnsThatAreNotUsedAreToldOfEveryFileThatHasOthers) {
  const auto written = [&](const std::string& name, const std::string& column) {
    std::string rows = "time_s,x_m,y_m," + column;
    for (int i = 0; i < 40; ++i) rows += fmt::format("\n{},{},{},0", i, 20 + i, name.size());
    return "'" + folder_.write(name, rows + "\n") + "' ";
  };
  const ProgramRun said = run("diagnose " + written("a.csv", "odour") + written("bb.csv", "odour") +
                              written("ccc.csv", "yaw_degrees") + "--scenario '" +
                              folder_.path("s.yaml") + "' --out '" + folder_.path("said") + "'");
  EXPECT_NE(said.errors.find("a.csv: odour not used\n"), std::string::npos) << said.errors;
  EXPECT_EQ(said.errors.find("bb.csv: odour"), std::string::npos) << said.errors;
  EXPECT_NE(said.errors.find("ccc.csv: yaw_degrees not used\n"), std::string::npos) << said.errors;
}

TEST_F(DriveDiagnosisProgram, ADriveTooShortToCompareIsUndecidedNotConsistent) {
  std::string path = "x_m,y_m,speed_mps\n20,30,0\n35,30,1.2\n";
  folder_.write("short.csv", path);
  const std::string s = folder_.path("s.yaml");
  run("drive '" + s + "' '" + folder_.path("short.csv") + "' --sensors A --out '" +
      folder_.path("driven") + "'");
  const ProgramRun said = run("diagnose '" + folder_.path("driven/drive.csv") + "' --scenario '" +
                              s + "' --out '" + folder_.path("said") + "'");
  EXPECT_EQ(said.status, 2) << said.errors;
  EXPECT_EQ(diagnosis()["verdict"], "undecided");
  EXPECT_EQ(schema("drive-diagnosis").errors(diagnosis()), std::vector<std::string>());
  EXPECT_NE(said.output.find("Undecided: nothing of 1 drive could be compared"), std::string::npos)
      << said.output;
  EXPECT_NE(said.output.find("What would decide: a minute on the map"), std::string::npos);
}

class DrivePageInTheBrowser : public InTheBrowser {
 protected:
  ScratchFolder results_;
};

TEST_F(DrivePageInTheBrowser, SaysOfNoVerdictThatItStandsWhereNoneWasJudged) {
  results_.write("s.yaml", "map:\n  soils: " REGOPLAN_SOURCE_DIR
                           "/scenarios/demo/soils.yaml\n"
                           "  terrain: {width_m: 80, height_m: 60, roughness_m: 0.03}\n"
                           "gravity_mps2: 1.62\n");
  std::string rows = "time_s,x_m,y_m";
  for (int i = 0; i < 80; ++i) rows += fmt::format("\n{},{},30", 0.5 * i, 20 + 0.5 * i);
  results_.write("d.csv", rows + "\n");
  const ProgramRun said = run_program(results_, "diagnose '" + results_.path("d.csv") +
                                                    "' --scenario '" + results_.path("s.yaml") +
                                                    "' --out '" + results_.path("said") + "'");
  ASSERT_EQ(said.status, 2) << said.errors;
  const std::string page = drawn(results_.read("said/report.html"));
  expect_drawn_without_error(page);
  EXPECT_EQ(page.find("is judged as before"), std::string::npos);
  EXPECT_NE(page.find("Not judged: there is no corrected map."), std::string::npos);
}

}  // namespace
}  // namespace regoplan
