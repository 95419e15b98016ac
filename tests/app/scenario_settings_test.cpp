#include "app/settings/scenario_settings.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <numbers>

#include "tests/app/flat_map.h"
#include "tests/app/simulant_model.h"
#include "tests/error_text.h"

namespace regoplan {
namespace {

class ScenarioSettings : public testing::Test {
 protected:
  ScenarioSettings() { write_elevation(flat_elevation(), folder_.path("dem.tif")); }

  Scenario scenario(const std::string& from, const std::string& to,
                    const ScenarioOverrides& overrides = {}) const {
    return read_scenario(folder_.write("s.yaml", replaced(flat_scenario(), from, to)), overrides);
  }
  PlanningProblem problem(const std::string& from, const std::string& to,
                          const ScenarioOverrides& overrides = {}) const {
    return scenario(from, to, overrides).problem;
  }
  /// Without the folder that the file stands in.
  std::string error_of(const std::string& from, const std::string& to,
                       const ScenarioOverrides& overrides = {}) const {
    const std::string text = error_text([&] { scenario(from, to, overrides); });
    return text.starts_with(folder_.path("")) ? text.substr(folder_.path("").size()) : text;
  }

  ScratchFolder folder_;
};

TEST_F(ScenarioSettings, AnglesAreHeldInRadiansAndOmissionsComeFromTheVehicle) {
  const PlanningProblem read = problem("heading_deg: 0", "heading_deg: 90");
  const Limits limits = default_limits(preset_vehicle("lrv"));
  EXPECT_DOUBLE_EQ(read.start.heading_rad, std::numbers::pi / 2);
  EXPECT_EQ(read.start.speed_mps, 0);
  EXPECT_EQ(read.limits.slope_max_rad, limits.slope_max_rad);
  EXPECT_EQ(read.limits.slip_angle_max_rad, limits.slip_angle_max_rad);
  EXPECT_EQ(read.limits.sinkage_max_m, limits.sinkage_max_m);
  EXPECT_EQ(read.speed_max_mps, read.vehicle.speed_max_mps);
  EXPECT_FALSE(read.goal.heading_rad);
}

TEST_F(ScenarioSettings, TheVehicleComesToRestAtTheGoalUnlessMoreIsAllowed) {
  EXPECT_EQ(problem("200", "201").goal.speed_max_mps, 0);
  EXPECT_EQ(problem("radius_m: 3", "radius_m: 3, speed_mps: {max: 1.5}").goal.speed_max_mps, 1.5);
  EXPECT_EQ(error_of("radius_m: 3}", "radius_m: 3, speed_mps: {max: 2}}\nspeed_mps: {max: 1}"),
            "s.yaml:7: goal.speed_mps.max: 2 is not valid (allowed: 0 to 1)");
  EXPECT_EQ(error_of("radius_m: 3", "radius_m: 3, speed_mps: {max: -1}").substr(0, 45),
            "s.yaml:7: goal.speed_mps.max: -1 is not valid");
  EXPECT_EQ(error_of("radius_m: 3", "radius_m: 3, speed_mps: 1").substr(0, 29),
            "s.yaml:7: goal.speed_mps: 1 i");
  EXPECT_EQ(error_of("radius_m: 3", "radius_m: 3, speed_mps: {min: 1}").substr(0, 24),
            "s.yaml:7: goal.speed_mps");
}

TEST_F(ScenarioSettings, ALimitThatIsGivenReplacesTheVehiclesAndNoOther) {
  const PlanningProblem read = problem("planner:", "limits: {slope_max_deg: 10}\nplanner:");
  EXPECT_DOUBLE_EQ(read.limits.slope_max_rad, 10 * std::numbers::pi / 180);
  EXPECT_EQ(read.limits.slip_max, default_limits(read.vehicle).slip_max);
}

TEST_F(ScenarioSettings, OneBudgetBoundsTheSearch) {
  EXPECT_EQ(problem("iterations: 200", "iterations: 7").search.iterations, 7);
  EXPECT_EQ(problem("iterations: 200", "time_s: 3").search.time_s, 3);
  EXPECT_TRUE(problem(std::string(kFlatPlanner) + "\n", "").search.time_s);
  EXPECT_EQ(error_of("iterations: 200", "iterations: 200, time_s: 3"),
            "s.yaml:8: planner.iterations: either time_s or iterations, not both");
}

TEST_F(ScenarioSettings, CountsOfASearchAreIntegersWithinTheirRange) {
  for (const char* count : {"2.5", "0", "101"}) {
    EXPECT_EQ(
        error_of("iterations: 200", fmt::format("iterations: 200, candidates: {}", count)),
        fmt::format("s.yaml:8: planner.candidates: {} is not valid (allowed: a whole number, 1 "
                    "to 100)",
                    count));
  }
  EXPECT_EQ(
      error_of("soil_draws: 12", "soil_draws: 100001"),
      "s.yaml:8: planner.soil_draws: 100001 is not valid (allowed: a whole number, 1 to 100000)");
  EXPECT_EQ(
      error_of("iterations: 200", "iterations: 2.5"),
      "s.yaml:8: planner.iterations: 2.5 is not valid (allowed: a whole number, 1 to 2000000000)");
  EXPECT_EQ(problem("iterations: 200", "iterations: 2000000000, candidates: 100").search.candidates,
            100);
}

TEST_F(ScenarioSettings, TheCommandLineTakesThePlaceOfTheFile) {
  const PlanningProblem read =
      problem("iterations: 200", "iterations: 200, seed: 4",
              {.planner = "RRT", .seed = 9, .time_s = 2.5, .candidates = 2, .threads = 1});
  EXPECT_EQ(read.search.planner, "RRT");
  EXPECT_EQ(read.search.seed, 9);
  EXPECT_EQ(read.search.time_s, 2.5);
  EXPECT_FALSE(read.search.iterations);
  EXPECT_EQ(read.search.candidates, 2);
  EXPECT_EQ(read.search.threads, 1);
}

TEST_F(ScenarioSettings, AModelReplacesTheSoilThatItNames) {
  const std::string model =
      folder_.write("m.yaml", replaced(kSimulantModel, "soil_name: simulant", "soil_name: mare"));
  const PlanningProblem read = problem("200", "201", {.model_file = model});
  EXPECT_EQ(read.map.soils().front().soil.mean.cohesion_pa, 800);
  EXPECT_EQ(read.map.soils().front().name, "mare");

  const std::string other = folder_.write("m.yaml", kSimulantModel);
  EXPECT_EQ(error_of("200", "201", {.model_file = other}),
            "m.yaml: soil_name: simulant is no soil of the map (it has: mare)");
  const std::string nameless =
      folder_.write("m.yaml", replaced(kSimulantModel, "soil_name: simulant\n", ""));
  EXPECT_TRUE(
      error_of("200", "201", {.model_file = nameless}).starts_with("m.yaml: soil_name is missing"));
}

TEST_F(ScenarioSettings, AModelWithMechanismsNeedsNoSoilOfTheMap) {
  const std::string nameless =
      folder_.write("m.yaml", replaced(replaced(kSimulantModel, "soil_name: simulant\n", ""),
                                       "mechanisms: []", "mechanisms: [{id: grousers}]"));
  const Scenario with_mechanism = scenario("200", "201", {.model_file = nameless});
  EXPECT_EQ(with_mechanism.problem.mechanisms.size(), 1u);
  EXPECT_EQ(with_mechanism.problem.map.soils().front().soil.mean.cohesion_pa,
            problem("200", "201").map.soils().front().soil.mean.cohesion_pa);
  ASSERT_FALSE(with_mechanism.notices.empty());
  EXPECT_NE(with_mechanism.notices.back().find("no soil_name"), std::string::npos);
}

TEST_F(ScenarioSettings, WhatAModelSaysOfItsTestBedIsLeftBehind) {
  const std::string model = folder_.write(
      "m.yaml", replaced(replaced(kSimulantModel, "soil_name: simulant\n", ""), "mechanisms: []",
                         "mechanisms: [{id: slope_tilt}, {id: grousers}, {id: load_transfer}, "
                         "{id: slip_scale}, {id: soil_zone}, {id: multi_pass}, "
                         "{id: soil_change, form: for_a_time}, {id: cohesion_drift, form: "
                         "for_a_time}, {id: soil_change}]"));
  const Scenario read = scenario("200", "201", {.model_file = model});
  ASSERT_EQ(read.problem.mechanisms.size(), 3u);
  EXPECT_EQ(read.problem.mechanisms[0].id, "grousers");
  EXPECT_EQ(read.problem.mechanisms[1].id, "multi_pass");
  EXPECT_EQ(read.problem.mechanisms[2].id, "soil_change");
  EXPECT_EQ(read.problem.mechanisms[2].form, "");
  const auto told = [&](const std::string& words) {
    return std::ranges::count_if(read.notices, [&](const std::string& notice) {
      return notice.find(words) != std::string::npos;
    });
  };
  EXPECT_EQ(told("is left out"), 6);
  EXPECT_EQ(told("slope_tilt is left out"), 1);
  EXPECT_EQ(told("multi_pass changes nothing here"), 1);
}

TEST_F(ScenarioSettings, WhatCannotBeAskedIsAnErrorWithItsLine) {
  for (const char* radius_m : {"0", "57", "1000000000"}) {  // the map is 40 m by 40 m
    EXPECT_EQ(error_of("radius_m: 3", std::string("radius_m: ") + radius_m),
              fmt::format("s.yaml:7: goal.radius_m: {} is not valid (allowed: above 0 to the map's "
                          "diagonal, 56.56)",
                          radius_m));
  }
  EXPECT_EQ(error_of("radius_m: 3", "radius: 3"),
            "s.yaml:7: goal: radius_m is missing (radius on line 7: did you mean radius_m?)");
  EXPECT_EQ(error_of("gravity_mps2: 1.62", "gravity_mps2: .nan"),
            "s.yaml:5: gravity_mps2: .nan is not valid (allowed: a number, above 0 to 100)");
  EXPECT_EQ(error_of("planner:", "speed_mps: {max: 50}\nplanner:").substr(0, 40),
            "s.yaml:8: speed_mps.max: 50 is not valid");
  EXPECT_EQ(error_of("radius_m: 3", "radius_m: 3, heading_deg: 5"),
            "s.yaml:7: goal: heading_deg and heading_tolerance_deg go together");
  EXPECT_EQ(error_of("planner:", "planer:").substr(0, 54),
            "s.yaml:8: planer: unknown key (did you mean planner?)");
  EXPECT_EQ(
      error_of("iterations: 200", "name: A*"),
      "s.yaml:8: planner.name: A* is not valid (allowed: auto | Lattice | StableSparse | StateCost "
      "| SST | RRT | KPIECE1 | EST | PDST | SyclopRRT | SyclopEST)");
}

TEST_F(ScenarioSettings, AFileThatIsNotThereIsAnErrorThatNamesWhoWantsIt) {
  EXPECT_TRUE(error_of("dem.tif", "no.tif").starts_with("s.yaml:2: map.elevation: "));
  EXPECT_NE(error_of("dem.tif", "no.tif").find("no.tif"), std::string::npos);
  EXPECT_TRUE(error_of(kOneSoil, "no.yaml").starts_with("s.yaml:3: map.soils: "));
  EXPECT_TRUE(error_of("vehicle: lrv", "vehicle: no.yaml").starts_with("s.yaml:4: vehicle: "));
  const std::string other = "soil.yaml";
  folder_.write(other, "soils: {}\n");
  EXPECT_NE(error_of("vehicle: lrv", "vehicle: " + other).find("(read as the vehicle that "),
            std::string::npos);
  EXPECT_EQ(error_of("iterations: 200", "seed: 99999999999999999999"),
            "s.yaml:8: planner.seed: 99999999999999999999 is not valid (allowed: a whole number, 0 "
            "to 9223372036854775807)");
  EXPECT_TRUE(error_of("vehicle: lrv", "vehicle: [1]").starts_with("s.yaml:4: vehicle: "));
}

TEST_F(ScenarioSettings, ManySoilsNeedARasterThatSaysWhereTheyAre) {
  EXPECT_NE(error_of(kOneSoil, REGOPLAN_SOURCE_DIR "/scenarios/demo/soils.yaml").find("soils"),
            std::string::npos);
}

TEST_F(ScenarioSettings, AFileNameMayHoldAnEnvironmentVariable) {
  unsetenv("REGOPLAN_TEST_FOLDER");
  EXPECT_EQ(error_of("dem.tif", "${REGOPLAN_TEST_FOLDER}/dem.tif"),
            "s.yaml:2: map.elevation: ${REGOPLAN_TEST_FOLDER}/dem.tif: the environment variable "
            "REGOPLAN_TEST_FOLDER is not set");
  setenv("REGOPLAN_TEST_FOLDER", folder_.path("").c_str(), 1);
  EXPECT_EQ(error_of("dem.tif", "${REGOPLAN_TEST_FOLDER}/dem.tif"), "");
}

TEST_F(ScenarioSettings, AClassRasterWithoutCrsTakesTheElevationsWithANotice) {
  ElevationRaster elevation = flat_elevation();
  elevation.frame.crs_wkt =
      R"(LOCAL_CS["site",UNIT["metre",1],AXIS["Easting",EAST],AXIS["Northing",NORTH]])";
  write_elevation(elevation, folder_.path("dem.tif"));
  write_classes({.frame = flat_elevation().frame, .code = std::vector<std::int32_t>(1600, 1)},
                folder_.path("classes.tif"));
  std::string soils = kOneSoil;
  soils.insert(1, "classes: {1: mare}, ");
  const Scenario read =
      scenario(std::string("soils: ") + kOneSoil, "soil_class: classes.tif\n  soils: " + soils);
  EXPECT_EQ(read.notices.size(), 1);
}

TEST_F(ScenarioSettings, SoilsInAnotherUnitAreToldAsASetupTellsThem) {
  const auto told = [](const std::vector<std::string>& notices, const std::string& words) {
    return std::ranges::any_of(notices, [&](const auto& n) { return n.ends_with(words); });
  };
  const char* const radians =
      ".friction_angle_deg: 0.65 is small for a soil (usual: from 2 on); suspected: radians";
  EXPECT_FALSE(told(scenario("gravity_mps2", "gravity_mps2").notices, radians));
  EXPECT_TRUE(told(scenario("friction_angle_deg: 35", "friction_angle_deg: 0.65").notices,
                   "map.soils.soils.mare" + std::string(radians)));
  // A model that takes the place of a soil of the map is a soil as well.
  const std::string model =
      replaced(replaced(kSimulantModel, "soil_name: simulant", "soil_name: mare"),
               "friction_angle_deg: 37.2", "friction_angle_deg: 0.65");
  const std::string file = folder_.write("m.yaml", model);
  EXPECT_TRUE(told(scenario("gravity_mps2", "gravity_mps2", {.model_file = file}).notices,
                   "m.yaml:7: soil" + std::string(radians)));
}

TEST_F(ScenarioSettings, AClassWithoutASoilIsToldWithItsCodeItsCellsAndTheRemedy) {
  ClassRaster classes{.frame = flat_elevation().frame, .code = std::vector<std::int32_t>(1600, 1)};
  classes.code[20 * 40 + 10] = 6;  // below the start
  classes.code[0] = 7;
  write_classes(classes, folder_.path("classes.tif"));
  const std::string soils = kOneSoil;
  const auto listing = [&](const std::string& listed) {
    return "soil_class: classes.tif\n  soils: {" + listed + soils.substr(1);
  };
  const std::string as_it_is = "soils: " + soils;
  EXPECT_EQ(error_of(as_it_is, listing("classes: {1: mare}, ")),
            "s.yaml:7: start: no soil at (10, 20): the soil classes hold the code 6 there, in 1 of "
            "1600 cells, and the soils do not list it (classes: 1; remedy: add 6: NAME to classes, "
            "or unmapped: NAME)");
  const auto told = [&](const std::string& listed) {
    const std::vector<std::string> notices = scenario(as_it_is, listing(listed)).notices;
    const auto found = std::ranges::find_if(
        notices, [](const auto& n) { return n.find("no soil is given") != std::string::npos; });
    return found == notices.end() ? "" : found->substr(folder_.path("").size());
  };
  EXPECT_EQ(told("classes: {1: mare, 6: mare}, "),
            "classes.tif: no soil is given for the code 7 (1 cell) of 1600 cells: their ground is "
            "forbidden; remedy: add 7: NAME to classes of the soils, or unmapped: NAME");
  EXPECT_EQ(told("classes: {1: mare, 6: mare, 7: mare}, "), "");
  EXPECT_EQ(told("unmapped: mare, classes: {1: mare}, "), "");
}

TEST_F(ScenarioSettings, ClassesThatLeavePartOfTheMapOutAreToldWithWhatItsSoilIsTakenFor) {
  const std::string soils = kOneSoil, as_it_is = "soils: " + soils;
  const auto told = [&](int rows, const std::string& more) -> std::string {
    ClassRaster classes{.frame = flat_elevation().frame,
                        .code = std::vector<std::int32_t>(static_cast<std::size_t>(rows) * 40, 1)};
    classes.frame.rows = rows;
    write_classes(classes, folder_.path("classes.tif"));
    const std::vector<std::string> notices =
        scenario(as_it_is, "soil_class: classes.tif\n  soils: {" + more + soils.substr(1)).notices;
    const auto found = std::ranges::find_if(
        notices, [](const auto& n) { return n.find(" % are ") != std::string::npos; });
    return found == notices.end() ? "" : found->substr(folder_.path("").size());
  };
  const std::string of_all = "unmapped: mare, classes: {1: mare}, ";
  EXPECT_EQ(told(40, of_all), "");
  EXPECT_EQ(told(30, of_all),
            "classes.tif: covers x 0 to 40 m, y 10 to 40 m of the map (x 0 to 40 m, y 0 to 40 m); "
            "the other 25 % are taken for mare");
  EXPECT_TRUE(told(30, "classes: {1: mare}, ").ends_with("the other 25 % are forbidden"));
}

TEST_F(ScenarioSettings, RocksWhollyOffTheMapAreToldWithTheirPlacesAndTheMapsBounds) {
  const std::string soils = std::string("soils: ") + kOneSoil;
  const auto told = [&](const std::string& rows) -> std::string {
    folder_.write("r.csv", "x_m,y_m,radius_m,height_m\n20,30,1,1\n" + rows);
    const std::vector<std::string> notices = scenario(soils, "rocks: r.csv\n  " + soils).notices;
    const auto found = std::ranges::find_if(
        notices, [](const auto& n) { return n.find("off the map") != std::string::npos; });
    return found == notices.end() ? "" : found->substr(folder_.path("").size());
  };
  EXPECT_EQ(told(""), "");
  EXPECT_EQ(told("40.5,20,1,1\n"), "");  // reaches over the edge
  EXPECT_EQ(told("100,5.5,1,1\n"),
            "r.csv: 1 of 2 rocks lies wholly off the map (x 0 to 40 m, y 0 to 40 m), where no path "
            "meets it: x_m 100, y_m 5.5, radius_m 1");
  // Off a corner: within the radius of either edge's line, and not of the map.
  EXPECT_EQ(told("40.9,40.9,1,1\n-3,5,2,1\n"),
            "r.csv: 2 of 3 rocks lie wholly off the map (x 0 to 40 m, y 0 to 40 m), where no path "
            "meets them: x_m 40.9, y_m 40.9, radius_m 1; x_m -3, y_m 5, radius_m 2");
  std::string many;
  for (int i = 0; i < 10; ++i) many += "100,5,1,1\n";
  EXPECT_TRUE(told(many).ends_with("; 2 others"));
}

}  // namespace
}  // namespace regoplan
