// `evaluate` as a person meets it.
#include "tests/app/evaluate_program.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

namespace regoplan {
namespace {

TEST_F(Evaluate, RanksPathsFeasibleOnesFirst) {
  const ProgramRun run =
      evaluate(file("off.csv", "x_m,y_m\n30,20\n38,20\n50,20\n") + " " +
               file("good.csv", "x_m,y_m,speed_mps\n8,20,0\n20,20,1\n30,21,0\n"));
  EXPECT_EQ(run.status, 0) << run.errors;
  const nlohmann::json paths = result()["paths"];
  ASSERT_EQ(paths.size(), 2);
  EXPECT_TRUE(paths[0]["file"].get<std::string>().ends_with("good.csv"));
  EXPECT_TRUE(paths[0]["feasible"]);
  EXPECT_FALSE(paths[1]["feasible"]);
  EXPECT_GT(paths[1]["refusal"]["x_m"], 35);
  for (const char* key : {"limiting", "quantiles", "probability_feasible", "sensitivity", "reason",
                          "probability_feasible_ci95", "margin_min", "tracked", "energy_j"}) {
    EXPECT_TRUE(paths[0].contains(key)) << key;
  }
  EXPECT_NE(folder_.read("out/report.html").find("good.csv"), std::string::npos);
}

TEST_F(Evaluate, SaysWhatTheMeanSoilsDecideAndWhatTheDrawsTell) {
  const std::string path = file("good.csv", "x_m,y_m,speed_mps\n8,20,0\n20,20,1\n30,21,0\n");
  const ProgramRun run = evaluate(path + " --threads 1");
  ASSERT_EQ(run.status, 0) << run.errors;
  EXPECT_TRUE(run.output.starts_with("1 of 1 feasible at the mean soils; ")) << run.output;
  const std::string known = folder_.read("out/report.html");
  for (const char* told :
       {"Verdict at mean soils", "is feasible at the mean soils.",
        "Over the draws of the soils it varies most with: soil numbers known."}) {
    EXPECT_NE(known.find(told), std::string::npos) << told;
  }
  // Fewer draws than tell uncertain numbers apart.
  std::string soils = folder_.read("scenario.yaml");
  for (const char* key : {"cohesion_pa: ", "friction_angle_deg: "}) {
    const std::size_t at = soils.find(key) + std::string(key).size();
    const std::size_t end = soils.find_first_of(",\n}", at);
    soils.replace(at, end - at, "{mean: " + soils.substr(at, end - at) + ", std: 1}");
  }
  folder_.write("scenario.yaml", soils);
  const ProgramRun doubtful =
      run_program(folder_, "evaluate '" + folder_.path("scenario.yaml") + "' " + path + " --out '" +
                               folder_.path("out") + "' --threads 1 --draws 4");
  ASSERT_EQ(doubtful.status, 0) << doubtful.errors;
  const std::string page = folder_.read("out/report.html");
  EXPECT_NE(page.find("it varies most with: too few draws to name one."), std::string::npos);
  EXPECT_EQ(page.find("too few draws to tell"), std::string::npos);
}

TEST_F(Evaluate, SaysWherePlanWouldNotCountAPathForItsProbability) {
  const std::string path = file("good.csv", "x_m,y_m,speed_mps\n8,20,0\n20,20,1\n30,21,0\n");
  std::string text = folder_.read("scenario.yaml");
  const std::size_t at = text.find("friction_angle_deg: ") + 20;
  const std::size_t end = text.find_first_of(",\n}", at);
  text.replace(at, end - at, "{mean: " + text.substr(at, end - at) + ", std: 1}");
  folder_.write("scenario.yaml", text + "\nlimits: {probability_min: 0.7}\n");
  const auto drawn = [&](int draws) {
    return run_program(folder_, "evaluate '" + folder_.path("scenario.yaml") + "' " + path +
                                    " --out '" + folder_.path("out") + "' --draws " +
                                    std::to_string(draws));
  };
  const ProgramRun few = drawn(4);  // which show at most .51
  ASSERT_EQ(few.status, 0) << few.errors;
  EXPECT_NE(few.output.find("but: plan would not count it: shown to hold in "), std::string::npos)
      << few.output;
  EXPECT_NE(folder_.read("out/report.html").find(", but plan would not count it"),
            std::string::npos);
  EXPECT_EQ(drawn(100).output.find("plan would not count it"), std::string::npos);
}

TEST_F(Evaluate, WhatWasNeverDrawnOrDrivenIsNoNumber) {
  const ProgramRun run = evaluate(file("away.csv", "x_m,y_m\n-30,20\n-10,20\n"));
  EXPECT_EQ(run.status, 2) << run.errors;
  const nlohmann::json path = result()["paths"][0];
  EXPECT_EQ(path["refusal"]["reason"], "bounds");
  EXPECT_EQ(path["soil_draws"]["draws"], 0);
  for (const char* key : {"limiting", "margin_min", "margin_worst_tenth", "margin_p05",
                          "margin_p05_ci95", "margin_p50", "margin_p50_ci95",
                          "probability_feasible", "probability_feasible_ci95", "energy_j"}) {
    EXPECT_TRUE(path[key].is_null()) << key;
  }
  EXPECT_TRUE(path["quantiles"]["margin"]["p05"].is_null());
  EXPECT_NE(run.output.find("bounds" + std::string(16, ' ') + "-" + std::string(9, ' ') + "-" +
                            std::string(8, ' ') + "-"),
            std::string::npos)
      << run.output;
}

TEST_F(Evaluate, NothingFeasibleEndsWithStatus2) {
  EXPECT_EQ(evaluate(file("off.csv", "x_m,y_m\n30,20\n50,20\n")).status, 2);
  EXPECT_EQ(result()["status"], "infeasible");
}

TEST_F(Evaluate, ACandidateOfPlanIsConfirmed) {
  const std::string plan_out = folder_.path("plan");
  const ProgramRun planned =
      run_program(folder_, "plan '" + folder_.path("scenario.yaml") + "' --out '" + plan_out +
                               "' --planner RRT --iterations 1000 --candidates 1 --quiet");
  ASSERT_EQ(planned.status, 0) << planned.errors;
  const auto candidate = nlohmann::json::parse(folder_.read("plan/plan.json"))["candidates"][0];
  EXPECT_EQ(evaluate("'" + plan_out + "/candidate-1.csv'").status, 0);
  const nlohmann::json path = result()["paths"][0];
  EXPECT_TRUE(path["feasible"]);
  EXPECT_NEAR(path["margin_min"], candidate["margin_min"], 0.02);
  EXPECT_NEAR(path["recorded"]["margin_min"], candidate["margin_min"], 1e-9);

  // Without the columns that are this program's own, steering and speeds tell the same.
  std::string text = folder_.read("plan/candidate-1.csv"), fewer;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    for (int k = 0; k < 2; ++k) line.erase(line.rfind(','));
    fewer += line + "\n";
  }
  EXPECT_EQ(evaluate(file("fewer.csv", fewer)).status, 0);
  EXPECT_NEAR(result()["paths"][0]["margin_min"], candidate["margin_min"], 0.02);
}

/// Less side force than the base model in the region of the flat map's manoeuvres.
constexpr const char* kCorrected = R"(model: ishigami2007
wheel: {radius_m: 0.41, width_m: 0.23}
gravity_mps2: 1.62
soil: {cohesion_pa: 170, friction_angle_deg: 35, kc: 1400, kphi: 8.2e5, n: 1, a0: .4, a1: .15,
       lambda: .1, density_kgpm3: 1600, kx0_m: .018, ky0_m: .018}
mechanisms:
  - id: generic
    form: gaussian_bumps
    parameters:
      slip_scale: 0.3
      slip_angle_scale_deg: 8
      log_load_scale: 1
      region: {slip_ratio: [-0.4, 0.6], slip_angle_deg: [0, 20], load_n: [100, 600]}
      fade_share: 0.05
      nodes: [{slip_ratio: 0.05, slip_angle_deg: 10, load_n: 290, fy_n: -60}]
)";

TEST_F(Evaluate, AnUnnamedCorrectionCountsInPlansAndEvaluations) {
  const std::string model = " --model " + file("corrected.yaml", kCorrected) + " --quiet ";
  const std::string turn =
      "--manoeuvres " +
      file("m.yaml", "- {kind: steady_turn, radius_m: 12, angle_deg: 60, speed_mps: 2}\n");
  ASSERT_EQ(evaluate(turn).status, 0);
  const double base = result()["paths"][0]["margin_min"];
  evaluate(turn + model);
  const double corrected = result()["paths"][0]["margin_min"];
  EXPECT_LT(corrected, base - 0.02);
  EXPECT_GT(corrected, base - 0.4);

  const std::string plan_out = folder_.path("plan");
  const ProgramRun planned =
      run_program(folder_, "plan '" + folder_.path("scenario.yaml") + "' --out '" + plan_out +
                               "' --planner RRT --iterations 1000 --candidates 1" + model);
  ASSERT_EQ(planned.status, 0) << planned.errors;
  const auto candidate = nlohmann::json::parse(folder_.read("plan/plan.json"))["candidates"][0];
  evaluate("'" + plan_out + "/candidate-1.csv'" + model);
  EXPECT_NEAR(result()["paths"][0]["margin_min"], candidate["margin_min"], 0.02);
}

TEST_F(Evaluate, ManoeuvresStandForEachCombination) {
  const ProgramRun run =
      evaluate("--manoeuvres " +
               file("m.yaml",
                    "- {kind: steady_turn, radius_m: 12, angle_deg: 60, speed_mps: [1, 3.5]}\n"
                    "- {kind: slope_traverse, length_m: 8, slope_deg: 5, speed_mps: 1}\n"));
  EXPECT_EQ(run.status, 0) << run.errors;
  const nlohmann::json paths = result()["paths"];
  ASSERT_EQ(paths.size(), 3);
  EXPECT_FALSE(paths[2]["feasible"]);
  EXPECT_EQ(paths[2]["refusal"]["reason"], "cornering");
}

TEST_F(Evaluate, ManoeuvresThatDifferInShapeAloneHaveNamesOfTheirOwn) {
  const ProgramRun run = evaluate(
      "--manoeuvres " +
      file("m.yaml",
           "- {kind: steady_turn, radius_m: 12, angle_deg: 20, speed_mps: 1}\n"
           "- {kind: steady_turn, radius_m: 15, angle_deg: 20, speed_mps: 1}\n"
           "- {kind: lane_change, offset_m: 1, length_m: 12, speed_mps: 1}\n"
           "- {kind: lane_change, offset_m: 1, length_m: 15, speed_mps: 1}\n"
           "- {kind: slope_traverse, slope_heading_deg: 0}\n"
           "- {kind: slope_traverse, slope_heading_deg: 90}\n"
           "- {kind: slalom, amplitude_m: 0.5, wavelength_m: 15, waves: 1, speed_mps: 1}\n"));
  ASSERT_EQ(run.status, 0) << run.errors;
  std::set<std::string> names;
  const nlohmann::json paths = result()["paths"];
  for (const nlohmann::json& path : paths) names.insert(path["manoeuvre"].get<std::string>());
  EXPECT_EQ(names.size(), 7U);
  EXPECT_TRUE(names.contains("steady_turn: radius 12 m, lrv, mare, 1 m/s, slope 0 deg"));
}

TEST_F(Evaluate, ExtraColumnsAreNoticedOnce) {
  const ProgramRun run = evaluate(file("p.csv", "x_m,note,y_m\n10,a,20\n25,b,20\n"));
  EXPECT_EQ(run.status, 0);
  EXPECT_NE(run.errors.find("columns ignored: note"), std::string::npos) << run.errors;
}

TEST_F(Evaluate, BadPathsAreRefusedWithFileAndLine) {
  expect_refused(file("p.csv", "x_m,y_m\n10,20\nnan,20\n"), {"p.csv:3: x_m: nan is not valid"});
  expect_refused(file("p.csv", "x_m,y_m\n10,20\n"), {"p.csv:2: ", "at least two points"});
  expect_refused(file("p.csv", "x_m,y_m\n10,20\n10,20\n10,20\n"), {"p.csv:4: ", "no length"});
  expect_refused(file("p.csv", "x_m\n10\n"), {"p.csv:1: column y_m is missing"});
  expect_refused(file("p.csv", "x_m,y_m,speed_mps\n10,20,0\n20,20,99\n30,20,0\n"),
                 {"p.csv:3: speed_mps: 99 is not valid"});
  expect_refused(file("p.csv", "x_m,y_m,speed_mps\n10,20,-1\n20,20,1\n30,20,0\n"),
                 {"p.csv:3: speed_mps: 1 is not valid", "one direction"});
  expect_refused(file("p.csv", ""), {"p.csv: empty"});
  expect_refused(fmt::format("'{}'", folder_.path("none.csv")), {"none.csv: no such file"});
  expect_refused(file("p.csv", "x_m,y_m\n10,20\n20,20\n") + " --speed 50", {"--speed: 50"});
  expect_refused("", {"nothing to evaluate"});
}

TEST_F(Evaluate, APathThatNeverMovesIsRefused) {
  const char* never = "p.csv:3: speed_mps: at rest both 0 m and 20 m along the path";
  expect_refused(file("p.csv", "x_m,y_m,speed_mps\n10,20,0\n30,20,0\n"), {never});
  expect_refused(file("p.csv", "x_m,y_m,speed_mps\n10,20,-0\n30,20,0\n"), {never});
  expect_refused(file("p.csv", "x_m,y_m,speed_mps\n10,20,0\n30,20,4e-324\n"), {never});
  // The last speed counts of points that lie together.
  expect_refused(file("p.csv", "x_m,y_m,speed_mps\n10,20,0\n30,20,1\n30.01,20,0\n"),
                 {"p.csv:4: speed_mps: at rest both 0 m and 20.01 m along the path"});
  EXPECT_EQ(evaluate(file("p.csv", "x_m,y_m,speed_mps\n10,20,0\n20,20,1\n30,20,0\n")).status, 0);
}

TEST_F(Evaluate, BadManoeuvresAreRefusedWithFileAndLine) {
  const auto manoeuvres = [this](const std::string& text) {
    return "--manoeuvres " + file("m.yaml", text);
  };
  expect_refused(manoeuvres("- {kind: point_turn}\n"), {"m.yaml:1: ", "cannot turn on the spot"});
  expect_refused(manoeuvres("- {kind: point_turn, vehicle: curiosity, turn_rate_deg_s: 90}\n"),
                 {"m.yaml:1: ", "turn_rate_deg_s: 90"});
  expect_refused(manoeuvres("- {kind: steady_turn}\n"), {"m.yaml:1: ", "radius_m is missing"});
  expect_refused(manoeuvres("- {kind: steady_turn, radius_m: 9, speed_mps: 70}\n"),
                 {"m.yaml:1: ", "speed_mps: 70"});
  const auto braking = [&](const std::string& values) {
    return manoeuvres("- {kind: braking_in_a_turn, " + values + "}\n");
  };
  expect_refused(braking("radius_m: 9, speed_mps: 1, braking_mps2: 1e20"),
                 {"m.yaml:1: ", "braking_mps2: 1e+20 is not valid (allowed: below "});
  expect_refused(braking("radius_m: 0.001, speed_mps: 1, braking_mps2: 0.001"),
                 {"m.yaml:1: ", "radius_m: 0.001 is too tight for 500 m of braking"});
  expect_refused(manoeuvres("- {kind: loop}\n"), {"m.yaml:1: ", "steady_turn"});
  expect_refused(manoeuvres("- {kind: steady_turn, radius_m: 9, soil: ice}\n"), {"ice", "mare"});
}

TEST_F(Evaluate, APointFarBeyondTheMapIsAMistakeANearOneOutOfBounds) {
  for (const char* far : {"9.2e18", "1e308", "-1e8", "1e6", "97"}) {
    expect_refused(file("p.csv", fmt::format("x_m,y_m\n10,20\n{},20\n12,20\n", far)),
                   {fmt::format("p.csv:3: x_m: {} is not valid", far), "diagonal"});
    expect_refused(file("p.csv", fmt::format("x_m,y_m\n10,20\n12,20\n12,{}\n", far)),
                   {fmt::format("p.csv:4: y_m: {} is not valid", far), "diagonal"});
  }
  EXPECT_EQ(evaluate(file("p.csv", "x_m,y_m\n30,20\n60,20\n90,20\n")).status, 2);
  EXPECT_EQ(result()["paths"][0]["refusal"]["reason"], "bounds");
}

TEST_F(Evaluate, WhatWouldTakeHoursIsRefusedBeforeItBegins) {
  const auto manoeuvres = [this](const std::string& text) {
    return "--manoeuvres " + file("m.yaml", text);
  };
  for (const char* kind :
       {"steady_turn, radius_m: 12", "slope_traverse, length_m: 8, slope_deg: 1",
        "lane_change, offset_m: 2, length_m: 12", "braking_in_a_turn, radius_m: 12",
        "slalom, amplitude_m: 1, "
        "wavelength_m: 15"}) {
    expect_refused(manoeuvres(fmt::format("- {{kind: {}, speed_mps: 1e-5}}\n", kind)),
                   {"m.yaml:1: ", "speed_mps: 1e-05 is not valid (allowed: at least "});
  }
  expect_refused(manoeuvres("- {kind: point_turn, vehicle: curiosity, turn_rate_deg_s: 1e-7}\n"),
                 {"m.yaml:1: ", "turn_rate_deg_s: 1e-07 is not valid (allowed: at least "});
  expect_refused(manoeuvres("- {kind: steady_turn, radius_m: 1e9}\n"), {"m.yaml:1: ", "50000 m"});
  expect_refused(manoeuvres("- {kind: lane_change, offset_m: 1e9, length_m: 5}\n"),
                 {"m.yaml:1: ", "50000 m"});
  expect_refused(manoeuvres("- {kind: slalom, amplitude_m: 1e300, wavelength_m: 5}\n"),
                 {"m.yaml:1: ", "50000 m"});
  expect_refused(file("p.csv", "x_m,y_m,speed_mps\n10,20,0\n20,20,1e-9\n30,20,0\n"),
                 {"p.csv: ", "(allowed: at most "});
  expect_refused(file("p.csv", "x_m,y_m\n10,20\n20,20\n") + " --speed 1e-9", {"p.csv: "});
}

TEST_F(Evaluate, HeedsInterruptsWhileItDrives) {
  // Some minutes of driving; well within what is taken on.
  const std::string slow = file("m.yaml",
                                "- {kind: slope_traverse, length_m: 20, slope_deg: 1, "
                                "speed_mps: 1e-4}\n");
  for (const auto& [signal, status] : {std::pair{"INT", 130}, std::pair{"TERM", 143}}) {
    const std::string command = fmt::format(
        "timeout --preserve-status -k 5 -s {} 2 '{}' evaluate '{}' --out '{}' "
        "--manoeuvres {} 2>'{}'",
        signal, REGOPLAN_PROGRAM, folder_.path("scenario.yaml"), folder_.path("out"), slow,
        folder_.path("errors"));
    const int ended = std::system(command.c_str());
    EXPECT_TRUE(WIFEXITED(ended));
    EXPECT_EQ(WEXITSTATUS(ended), status);
    EXPECT_EQ(folder_.read("errors"), "regoplan: interrupted\n");
    EXPECT_EQ(result()["interrupted"], true);
    EXPECT_TRUE(result()["paths"].empty());
    EXPECT_EQ(result()["status"], "undecided");
  }
}

TEST_F(Evaluate, ASignalThatComesTwiceAtOnceIsOneRequest) {
  // As `timeout` sends it: to the process, and to its group.
  const std::string slow = file("m.yaml",
                                "- {kind: slope_traverse, length_m: 20, slope_deg: 1, "
                                "speed_mps: 1e-4}\n");
  const std::string command = fmt::format(
      "'{}' evaluate '{}' --out '{}' --quiet --manoeuvres {} 2>/dev/null & "
      "sleep 2; kill -TERM $!; sleep 0.02; kill -TERM $!; wait $!",
      REGOPLAN_PROGRAM, folder_.path("scenario.yaml"), folder_.path("out"), slow);
  const int ended = std::system(command.c_str());
  EXPECT_TRUE(WIFEXITED(ended));
  EXPECT_EQ(WEXITSTATUS(ended), 143);
  EXPECT_EQ(result()["interrupted"], true);
}

TEST_F(Evaluate, OptionsThatDoNotGoTogetherAreRefused) {
  const std::string path = file("p.csv", "x_m,y_m\n10,20\n20,20\n");
  for (const char* option : {"--chart-speed-mps 2", "--chart-slopes-deg 0", "--gravity-mps2 1.62",
                             "--vehicle lrv", "--soils soils.yaml"}) {
    const std::string given(option);
    expect_refused(path + " " + given, {given.substr(0, given.find(' ')) + " requires --chart"});
  }
  expect_refused("--chart '" + folder_.path("chart") + "'", {"--chart takes no --out"});
  EXPECT_FALSE(std::filesystem::exists(folder_.path("chart")));
}

}  // namespace
}  // namespace regoplan
