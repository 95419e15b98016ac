#include "app/settings/effective_settings.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/settings/scenario_settings.h"
#include "app/settings/vehicle_settings.h"
#include "terramech/basics/angles.h"
#include "tests/app/flat_map.h"
#include "tests/app/program_run.h"
#include "tests/error_text.h"

namespace regoplan {
namespace {

using OrderedJson = nlohmann::ordered_json;

class EffectiveSettings : public testing::Test {
 protected:
  EffectiveSettings() { write_flat_scenario(folder_); }

  PlanningProblem read(const std::string& text) const {
    return read_scenario(folder_.write("s.yaml", text), {}).problem;
  }

  /// The settings as the scenario that they are meant to be.
  static std::string as_scenario(const OrderedJson& settings) {
    std::string text = std::string("map:\n  elevation: dem.tif\n  soils: ") + kOneSoil + "\n";
    for (const auto& [key, value] : settings.items()) text += key + ": " + value.dump() + "\n";
    return text;
  }

  /// On ground so steep that nothing is planned, so that the answer comes at once.
  OrderedJson settings_of_a_run(const std::string& planner, const std::string& flags) const {
    ElevationRaster steep = flat_elevation();
    for (std::size_t i = 0; i < steep.height_m.size(); ++i) {
      steep.height_m[i] = static_cast<float>(i % 40);
    }
    write_elevation(steep, folder_.path("dem.tif"));
    folder_.write("scenario.yaml", replaced(flat_scenario(), kFlatPlanner, planner));
    const ProgramRun run =
        run_program(folder_, "plan '" + folder_.path("scenario.yaml") + "' --out '" +
                                 folder_.path("out") + "' " + flags);
    EXPECT_EQ(run.status, 2) << run.errors;
    return OrderedJson::parse(folder_.read("out/plan.json")).at("settings");
  }

  ScratchFolder folder_;
};

TEST_F(EffectiveSettings, ReadBackAsTheProblemThatTheySay) {
  PlanningProblem problem = read(flat_scenario());
  problem.vehicle.name = "true";
  problem.vehicle.torque_max_nm = 12.5;
  problem.start = {.x_m = 10.1, .y_m = 20.2, .heading_rad = 33.3 * kDegree, .speed_mps = 0.7};
  problem.goal = {.x_m = 30.3,
                  .y_m = 20.4,
                  .radius_m = 2.6,
                  .heading_rad = -170.1 * kDegree,
                  .heading_tolerance_rad = 12.3 * kDegree,
                  .speed_max_mps = 0.9};
  problem.speed_max_mps = 1.7;
  problem.limits = {.margin_min = 0.07,
                    .slip_max = 0.41,
                    .slip_angle_max_rad = 11.1 * kDegree,
                    .slope_max_rad = 13.3 * kDegree,
                    .sinkage_max_m = 0.021,
                    .probability_min = 0.83};
  problem.search = {.planner = "RRT",
                    .objective = {.per_s = 0.3,
                                  .per_m = 0.2,
                                  .per_j = 1e-3,
                                  .per_exposed_s = 4,
                                  .exposed_below = 0.31},
                    .time_s = {},
                    .iterations = 12345,
                    .seed = 99,
                    .candidates = 3,
                    .improve = false,
                    .soil_draws = 170,
                    .threads = problem.search.threads};
  const PlanningProblem again = read(as_scenario(effective_settings(problem)));
  EXPECT_EQ(vehicle_text(again.vehicle), vehicle_text(problem.vehicle));
  EXPECT_EQ(again.gravity_mps2, problem.gravity_mps2);
  EXPECT_EQ(again.start, problem.start);
  EXPECT_EQ(again.goal, problem.goal);
  EXPECT_EQ(again.speed_max_mps, problem.speed_max_mps);
  EXPECT_EQ(again.limits, problem.limits);
  EXPECT_EQ(again.search, problem.search);
}

TEST_F(EffectiveSettings, OfARunWithoutOptionsAreTheDefaultsOfTheStructs) {
  PlanningProblem problem = read(flat_scenario());
  problem.search = {.time_s = kSearchTimeDefault_s, .iterations = {}};
  problem.limits = default_limits(problem.vehicle);
  problem.speed_max_mps = problem.vehicle.speed_max_mps;
  EXPECT_EQ(settings_of_a_run("", ""), effective_settings(problem));
}

TEST_F(EffectiveSettings, ImproveIsWhatTheFlagSaysElseTheScenarioElseYes) {
  const auto improve = [this](const std::string& planner, const std::string& flags) {
    return settings_of_a_run(planner, flags).at("planner").at("improve").get<bool>();
  };
  EXPECT_TRUE(improve("", ""));
  EXPECT_TRUE(improve("planner: {improve: true}", ""));
  EXPECT_FALSE(improve("planner: {improve: false}", ""));
  EXPECT_FALSE(improve("planner: {improve: true}", "--no-improve"));
  EXPECT_TRUE(improve("planner: {improve: false}", "--improve"));
}

TEST_F(EffectiveSettings, WhatIsFoundIsImprovedUnlessSomebodySaysNo) {
  std::string text = replaced(flat_scenario(), "goal: {x_m: 30, y_m: 20, radius_m: 3}",
                              "goal: {x_m: 22, y_m: 32, radius_m: 1.5}");
  text = replaced(text, kFlatPlanner,
                  "planner: {name: RRT, iterations: 500, candidates: 1, soil_draws: 5}");
  const std::string scenario = folder_.write("scenario.yaml", text);
  const auto improved = [&](int seed, const std::string& flags) {
    const ProgramRun run =
        run_program(folder_, fmt::format("plan '{}' --out '{}' --seed {} {}", scenario,
                                         folder_.path("out"), seed, flags));
    EXPECT_EQ(run.status, 0) << run.errors;
    return OrderedJson::parse(folder_.read("out/plan.json")).at("candidates").at(0).at("improved");
  };
  // Now and then a tree's first path is one that nothing betters.
  int seed = 2;
  OrderedJson by_default = improved(seed, "");
  while (by_default.is_null() && seed < 6) by_default = improved(++seed, "");
  ASSERT_FALSE(by_default.is_null());
  EXPECT_LT(by_default.at("cost_after"), by_default.at("cost_before"));
  EXPECT_TRUE(improved(seed, "--no-improve").is_null());
}

/// What docs/scenario.md gives as the default of a key.
std::string documented_default(const std::string& key) {
  std::ifstream page("docs/scenario.md");
  for (std::string line; std::getline(page, line);) {
    if (!line.starts_with("| `" + key + "`")) continue;
    const std::size_t end = line.rfind(" |");
    const std::size_t begin = line.rfind("| ", end - 1) + 2;
    return line.substr(begin, end - begin);
  }
  return "not in the table";
}

TEST_F(EffectiveSettings, AreWhatTheDocumentsGiveAsDefaults) {
  const OrderedJson settings = settings_of_a_run("", "");
  const OrderedJson& planner = settings.at("planner");
  EXPECT_EQ(documented_default("planner: name"), planner.at("name").get<std::string>());
  EXPECT_EQ(documented_default("planner: improve"), planner.at("improve").dump());
  EXPECT_EQ(documented_default("planner: time_s"),
            fmt::format("`time_s: {}`", planner.at("time_s").get<double>()));
  EXPECT_EQ(documented_default("planner: seed"),
            fmt::format("{}; {}; {}", planner.at("seed").dump(), planner.at("candidates").dump(),
                        planner.at("soil_draws").dump()));
  EXPECT_EQ(documented_default("planner: objective: {per_s, per_m, per_j, per_exposed_s, "
                               "exposed_below}"),
            "time");
  EXPECT_EQ(planner.at("objective"),
            OrderedJson::parse(R"({"per_s": 1.0, "per_m": 0.0, "per_j": 0.0,
                                        "per_exposed_s": 0.0, "exposed_below": 0.2})"));
  EXPECT_EQ(documented_default("limits: margin_min"),
            settings.at("limits").at("margin_min").dump());
  EXPECT_EQ(documented_default("limits: probability_min"), "none");
  EXPECT_EQ(settings.at("limits").at("probability_min"), 0);
  EXPECT_EQ(documented_default("goal: {speed_mps: {max}}"), "0: comes to rest there");
  EXPECT_EQ(settings.at("goal").at("speed_mps").at("max"), 0);
  EXPECT_EQ(documented_default("speed_mps: {max}"), "the vehicle's");
  EXPECT_EQ(settings.at("speed_mps").at("max"), settings.at("vehicle").at("speed_max_mps"));
  const std::vector<std::pair<std::string, std::string>> of_the_vehicle{
      {"limits: slip_max", "slip_max"},
      {"limits: slip_angle_max_deg", "slip_angle_max_deg"},
      {"limits: slip_angle_max_deg", "slope_max_deg"},
      {"limits: sinkage_max_m", "sinkage_max_m"}};
  for (const auto& [row, key] : of_the_vehicle) {
    EXPECT_EQ(documented_default(row), "the vehicle's");
    EXPECT_EQ(settings.at("limits").at(key), settings.at("vehicle").at(key)) << key;
  }
}

TEST_F(EffectiveSettings, AreWhatTheHelpGivesAsDefaults) {
  const OrderedJson planner = settings_of_a_run("", "").at("planner");
  const std::string help = run_program(folder_, "plan --help").output;
  const auto otherwise = [&help](const std::string& option) {
    const std::string_view lead = ", else ";
    const std::size_t at = help.find(lead, help.find("  " + option + " ")) + lead.size();
    return help.substr(at, help.find('\n', at) - at);
  };
  EXPECT_EQ(otherwise("--planner"), planner.at("name").get<std::string>());
  EXPECT_EQ(otherwise("--seed"), planner.at("seed").dump());
  EXPECT_EQ(otherwise("--time"), fmt::format("{}", planner.at("time_s").get<double>()));
  EXPECT_EQ(otherwise("--candidates"), planner.at("candidates").dump());
  EXPECT_EQ(otherwise("--improve"), planner.at("improve").get<bool>() ? "yes" : "no");
}

TEST_F(EffectiveSettings, APathIsFollowedAsTheHelpSaysUnlessAskedForOtherwise) {
  folder_.write("path.csv", "x_m,y_m\n8,20\n20,20.5\n");
  for (const std::string command : {"evaluate", "drive"}) {
    const ProgramRun run = run_program(
        folder_, fmt::format("{} '{}' '{}' --out '{}'", command, folder_.path("scenario.yaml"),
                             folder_.path("path.csv"), folder_.path(command)));
    ASSERT_EQ(run.status, 0) << run.errors;
    const std::string file = command + (command == "drive" ? "/drive.json" : "/evaluation.json");
    const std::string follower = OrderedJson::parse(folder_.read(file)).at("follower");
    EXPECT_EQ(follower, "compensated");
    const std::string help = run_program(folder_, command + " --help").output;
    EXPECT_NE(help.find(follower + " (default)"), std::string::npos) << help;
  }
}

}  // namespace
}  // namespace regoplan
