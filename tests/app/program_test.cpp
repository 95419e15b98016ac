// The program as a person meets it.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "app/settings/vehicle_settings.h"
#include "app/wheel/other_names.h"
#include "terramech/mechanisms/mechanism.h"
#include "tests/app/flat_map.h"
#include "tests/app/json_schema.h"
#include "tests/app/program_run.h"
#include "tests/app/simulant_model.h"
#include "tests/error_text.h"

namespace regoplan {
namespace {

constexpr const char* kPlanarCrs =
    R"(PROJCS["WGS 84 / UTM zone 33N",GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]],PROJECTION["Transverse_Mercator"],PARAMETER["latitude_of_origin",0],PARAMETER["central_meridian",15],PARAMETER["scale_factor",0.9996],PARAMETER["false_easting",500000],PARAMETER["false_northing",0],UNIT["metre",1],AUTHORITY["EPSG","32633"]])";
constexpr const char* kOtherPlanarCrs =
    R"(PROJCS["WGS 84 / UTM zone 34N",GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]],PROJECTION["Transverse_Mercator"],PARAMETER["latitude_of_origin",0],PARAMETER["central_meridian",21],PARAMETER["scale_factor",0.9996],PARAMETER["false_easting",500000],PARAMETER["false_northing",0],UNIT["metre",1],AUTHORITY["EPSG","32634"]])";
constexpr const char* kDegreesCrs =
    R"(GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433],AUTHORITY["EPSG","4326"]])";

/// Every bad scenario ends the same way.
class BadScenario : public testing::Test {
 protected:
  BadScenario() { write_flat_scenario(folder_); }

  void change(const std::string& from, const std::string& to) const {
    folder_.write("scenario.yaml", replaced(folder_.read("scenario.yaml"), from, to));
  }

  /// Plans; expects one line that holds all of `words`, status 1 and nothing written.
  void expect_refused(const std::vector<std::string>& words, const std::string& more = "") const {
    const long files = folder_.count();
    expect_refusal(run_program(folder_, "plan '" + folder_.path("scenario.yaml") + "' --out '" +
                                            folder_.path("out") + "' " + more),
                   words);
    EXPECT_FALSE(std::filesystem::exists(folder_.path("out")));
    EXPECT_EQ(folder_.count(), files);
  }

  ScratchFolder folder_;
};

TEST_F(BadScenario, MissingScenario) {
  std::filesystem::remove(folder_.path("scenario.yaml"));
  expect_refused({"scenario.yaml: no such file"});
}

TEST_F(BadScenario, MissingRaster) {
  std::filesystem::remove(folder_.path("dem.tif"));
  expect_refused({"scenario.yaml:2: map.elevation: ", "dem.tif"});
}

TEST_F(BadScenario, RasterThatIsNone) {
  folder_.write("dem.tif", "no raster at all");
  expect_refused({"scenario.yaml:2: map.elevation: ", "dem.tif"});
}

TEST_F(BadScenario, RasterInDegrees) {
  ElevationRaster elevation = flat_elevation();
  elevation.frame.crs_wkt = kDegreesCrs;
  write_elevation(elevation, folder_.path("dem.tif"));
  expect_refused({"scenario.yaml:2: map.elevation: ", "dem.tif", "degrees"});
}

TEST_F(BadScenario, ClassRasterInAnotherCrs) {
  ElevationRaster elevation = flat_elevation();
  elevation.frame.crs_wkt = kPlanarCrs;
  write_elevation(elevation, folder_.path("dem.tif"));
  ClassRaster classes{.frame = elevation.frame, .code = std::vector<std::int32_t>(1600, 1)};
  classes.frame.crs_wkt = kOtherPlanarCrs;
  write_classes(classes, folder_.path("classes.tif"));
  change("  soils: {", "  soil_class: classes.tif\n  soils: {classes: {1: mare}, ");
  expect_refused({"scenario.yaml:3: map.soil_class: ", "classes.tif", "CRS"});
}

TEST_F(BadScenario, StartOutsideTheMap) {
  change("start: {x_m: 10", "start: {x_m: -100");
  expect_refused({"scenario.yaml:6: start"});
}

TEST_F(BadScenario, StartOnUnknownGround) {
  ElevationRaster elevation = flat_elevation();
  elevation.height_m[20 * 40 + 10] = std::numeric_limits<float>::quiet_NaN();
  write_elevation(elevation, folder_.path("dem.tif"));
  expect_refused({"scenario.yaml:6: start"});
}

TEST_F(BadScenario, StartOnARock) {
  folder_.write("rocks.csv", "x_m,y_m,radius_m,height_m\n10.2,20.1,0.8,1.5\n");
  change("  elevation:", "  rocks: rocks.csv\n  elevation:");
  expect_refused({"scenario.yaml:7: start", "rock"});
}

TEST_F(BadScenario, GoalOutsideTheMap) {
  change("goal: {x_m: 30", "goal: {x_m: 300");
  expect_refused({"scenario.yaml:7: goal"});
}

TEST_F(BadScenario, GoalRadiusZero) {
  change("radius_m: 3", "radius_m: 0");
  expect_refused(
      {"scenario.yaml:7: goal.radius_m: 0 is not valid (allowed: above 0 to the map's "
       "diagonal, 56.56)"});
}

TEST_F(BadScenario, UnknownKey) {
  change("gravity_mps2: 1.62", "gravity_mps2: 1.62\ngravty: 3");
  expect_refused({"scenario.yaml:6: gravty: unknown key"});
}

TEST_F(BadScenario, NegativeMass) {
  const std::string lrv = vehicle_text(preset_vehicle("lrv"));
  const std::size_t at = lrv.find("mass_kg: ");
  folder_.write("mine.yaml", lrv.substr(0, at) + "mass_kg: -5" + lrv.substr(lrv.find('\n', at)));
  change("vehicle: lrv", "vehicle: mine.yaml");
  expect_refused({"mine.yaml:3: mass_kg: -5 is not valid (allowed: 0.1 to 1000000)"});
}

TEST_F(BadScenario, NanWhereANumberIsNeeded) {
  change("gravity_mps2: 1.62", "gravity_mps2: .nan");
  expect_refused({"scenario.yaml:5: gravity_mps2: .nan is not valid"});
}

TEST_F(BadScenario, BadOptions) {
  expect_refused({"--time: nan"}, "--time nan");
  expect_refused({"--candidates: 0"}, "--candidates 0");
  expect_refused({"--planner: A*"}, "--planner 'A*'");
  expect_refused({"--bogus"}, "--bogus");
  expect_refused({"--iterations"}, "--iterations 5 --time 5");
  expect_refused({"none.yaml: no such file"}, "--model none.yaml");
  for (const char* seed : {"-1", "1.5", "9223372036854775808", "18446744073709551616"}) {
    expect_refused({"--seed", std::string(seed) + " is not valid", "0 to 9223372036854775807"},
                   std::string("--seed=") + seed);
  }
}

TEST_F(BadScenario, ResultsThatCouldNotBeWritten) {
  folder_.write("file", "");
  const ProgramRun run = run_program(
      folder_, "plan '" + folder_.path("scenario.yaml") + "' --out '" + folder_.path("file") + "'");
  EXPECT_EQ(run.status, 1);
  EXPECT_EQ(run.errors, "regoplan: --out: " + folder_.path("file") + ": not a folder\n");
}

TEST_F(BadScenario, ResultsThatTheSystemHasNoPlaceForAreRefusedBeforeTheSearch) {
  const std::string scenario = " '" + folder_.path("scenario.yaml") + "' ";
  folder_.write("p.csv", "x_m,y_m\n10,20\n20,20\n");
  const std::string path = "'" + folder_.path("p.csv") + "' ";
  const std::vector<std::string> commands = {
      "plan" + scenario + "--time 600",
      "evaluate" + scenario + path,
      "drive" + scenario + path,
      "diagnose none.csv --scenario" + scenario,
      "diagnose none.csv --setup none.yaml",
      "demo --time 600",
      "map make",
      "map import --gravity-mps2 1.62 --soils none.yaml --elevation none.tif"};
  for (const std::string& command : commands) {
    const ProgramRun refused = run_program(folder_, command + " --out /proc/x");
    expect_refusal(refused, {"regoplan: --out: /proc/x: cannot be made: "});
  }
  expect_refusal(run_program(folder_, "export none --nav2 /proc/x"), {"--nav2: /proc/x: "});
}

class Program : public testing::Test {
 protected:
  ProgramRun run(const std::string& arguments) const { return run_program(folder_, arguments); }
  std::string quoted(const std::string& name) const { return " '" + folder_.path(name) + "' "; }

  ScratchFolder folder_;
};

TEST_F(Program, HelpAndVersionAreAnswersOnStandardOutput) {
  for (const char* arguments :
       {"--help", "plan --help", "wheel --help", "map --help", "map make --help", "map info --help",
        "map import --help", "demo --help", "evaluate --help", "diagnose --help"}) {
    const ProgramRun help = run(arguments);
    EXPECT_EQ(help.status, 0) << arguments;
    EXPECT_EQ(help.errors, "") << arguments;
    EXPECT_NE(help.output.find("Usage: regoplan"), std::string::npos) << arguments;
  }
  EXPECT_TRUE(run("--version").output.starts_with("regoplan "));
}

TEST_F(Program, WhatIsMissingIsToldWithTheHelpOfItsCommand) {
  expect_refusal(run("plan x.yaml"), {"--out", "(regoplan plan --help)"});
  expect_refusal(run("map make"), {"--out", "(regoplan map make --help)"});
}

TEST_F(Program, AnUnknownCommandIsOneLine) {
  const ProgramRun unknown = run("frobnicate");
  EXPECT_EQ(unknown.status, 1);
  EXPECT_EQ(unknown.errors, "regoplan: unknown command frobnicate (regoplan --help)\n");
  expect_refusal(run("plna s.yaml --out o"),
                 {"unknown command plna (did you mean plan? regoplan --help)"});
  expect_refusal(run("map mke --out o"),
                 {"unknown command mke (did you mean make? regoplan map --help)"});
}

TEST_F(Program, WheelWritesTheSameTableToAFileAndToStandardOutput) {
  folder_.write("m.yaml", kSimulantModel);
  folder_.write("c.csv", "load_n,slip_ratio,slip_angle_deg\n64.7,0.3,12\n1e7,0,0\n");
  const ProgramRun shown = run("wheel" + quoted("c.csv") + "--model" + quoted("m.yaml"));
  const ProgramRun written =
      run("wheel" + quoted("c.csv") + "--model" + quoted("m.yaml") + "--out" + quoted("o.csv"));
  EXPECT_EQ(shown.status, 0);
  EXPECT_EQ(written.status, 0);
  EXPECT_EQ(written.output, "");
  EXPECT_EQ(folder_.read("o.csv"), shown.output);
  EXPECT_NE(shown.output.find(",,,,,,sinks_to_axle\n"), std::string::npos);
}

TEST_F(Program, WheelLeavesNoTableWhereARowIsBad) {
  folder_.write("m.yaml", kSimulantModel);
  folder_.write("c.csv", "load_n,slip_ratio,slip_angle_deg\n64.7,0.3,12\n64.7,two,12\n");
  folder_.write("o.csv", "older");
  const ProgramRun bad =
      run("wheel" + quoted("c.csv") + "--model" + quoted("m.yaml") + "--out" + quoted("o.csv"));
  EXPECT_EQ(bad.status, 1);
  EXPECT_EQ(bad.errors, "regoplan: " + folder_.path("c.csv") +
                            ":3: slip_ratio: two is not valid (allowed: -1 to 1)\n");
  EXPECT_EQ(folder_.read("o.csv"), "older");
  EXPECT_EQ(folder_.count(), 3);
}

TEST_F(Program, FiguresOfTheWheelAreNoTable) {
  for (const std::string option : {"--json", "--out o.csv"}) {
    const ProgramRun told = run("wheel --figures" + quoted("figures") + option);
    EXPECT_EQ(told.status, 1) << option;
    EXPECT_NE(told.errors.find(option.substr(0, option.find(' ')) + " excludes --figures"),
              std::string::npos)
        << told.errors;
  }
  EXPECT_FALSE(std::filesystem::exists(folder_.path("figures")));
}

TEST_F(Program, TheMechanismsOfAModelFileHaveNoJson) {
  folder_.write("model.yaml", kSimulantModel);
  EXPECT_EQ(run("mechanisms --model" + quoted("model.yaml")).status, 0);
  const ProgramRun told = run("mechanisms --json --model" + quoted("model.yaml"));
  EXPECT_EQ(told.status, 1);
  EXPECT_EQ(told.output, "");
  EXPECT_NE(told.errors.find("--model excludes --json"), std::string::npos) << told.errors;
}

TEST_F(Program, WheelNeverOverwritesItsInput) {
  folder_.write("m.yaml", kSimulantModel);
  folder_.write("c.csv", "load_n,slip_ratio,slip_angle_deg\n64.7,0.3,12\n");
  EXPECT_EQ(
      run("wheel" + quoted("c.csv") + "--model" + quoted("m.yaml") + "--out" + quoted("c.csv"))
          .status,
      1);
  EXPECT_EQ(folder_.read("c.csv"), "load_n,slip_ratio,slip_angle_deg\n64.7,0.3,12\n");
}

TEST_F(Program, AMadeMapIsDescribedAndSoIsItsRaster) {
  const ProgramRun made =
      run("map make --width-m 60 --height-m 60 --seed 3 --json --out" + quoted("m"));
  ASSERT_EQ(made.status, 0) << made.errors;
  for (const char* name : {"dem.tif", "classes.tif", "rocks.csv", "soils.yaml", "scenario.yaml"}) {
    EXPECT_TRUE(std::filesystem::exists(folder_.path("m/") + name)) << name;
  }
  const ProgramRun info = run("map info --json" + quoted("m/scenario.yaml") + quoted("m/dem.tif"));
  ASSERT_EQ(info.status, 0) << info.errors;
  const auto json = nlohmann::json::parse(info.output);
  EXPECT_EQ(json[folder_.path("m/scenario.yaml")]["columns"], 120);
  EXPECT_EQ(json[folder_.path("m/scenario.yaml")]["soils"].size(), 3);
  EXPECT_EQ(json[folder_.path("m/dem.tif")]["columns"], 120);
}

TEST_F(Program, SameSettingsMakeTheSameMapBitForBit) {
  const std::string settings = "map make --width-m 60 --height-m 60 --seed 3 --quiet --out";
  ASSERT_EQ(run(settings + quoted("a")).status, 0);
  ASSERT_EQ(run(settings + quoted("b")).status, 0);
  for (const char* name : {"dem.tif", "classes.tif", "rocks.csv", "soils.yaml", "scenario.yaml"}) {
    EXPECT_EQ(folder_.read(std::string("a/") + name), folder_.read(std::string("b/") + name))
        << name;
  }
}

TEST_F(Program, AnImportedMapIsTheMapItWasMadeOf) {
  ASSERT_EQ(run("map make --width-m 60 --height-m 60 --quiet --out" + quoted("a")).status, 0);
  const ProgramRun import =
      run("map import --gravity-mps2 3.71 --vehicle curiosity --elevation" + quoted("a/dem.tif") +
          "--soil-class" + quoted("a/classes.tif") + "--soils" + quoted("a/soils.yaml") +
          "--rocks" + quoted("a/rocks.csv") + "--out" + quoted("b"));
  ASSERT_EQ(import.status, 0) << import.errors;
  for (const char* name : {"dem.tif", "classes.tif", "rocks.csv", "soils.yaml"}) {
    EXPECT_EQ(folder_.read(std::string("a/") + name), folder_.read(std::string("b/") + name))
        << name;
  }
  EXPECT_NE(folder_.read("b/scenario.yaml").find("gravity_mps2: 3.71"), std::string::npos);
}

TEST_F(Program, ABadMapSettingIsNamedAsItsOption) {
  const ProgramRun bad = run("map make --cell-m -1 --out" + quoted("m"));
  EXPECT_EQ(bad.status, 1);
  EXPECT_TRUE(bad.errors.starts_with("regoplan: --cell-m: -1 is not valid")) << bad.errors;
  EXPECT_FALSE(std::filesystem::exists(folder_.path("m")));
}

TEST_F(Program, ABadNumberIsToldBeforeFilesAreReadOrFolders) {
  folder_.write("file", "");
  const std::string lost = " --soils none.yaml --out" + quoted("file");
  for (const auto& [given, error] :
       {std::pair{"--crater-density-scale -5", "-5 is not valid (allowed: 0 to 4)"},
        std::pair{"--rock-coverage 2", "2 is not valid (allowed: 0 to 0.3)"},
        std::pair{"--soil-zones 0", "0 is not valid (allowed: a whole number, 1 to 100)"},
        std::pair{"--width-m inf", "inf is not valid"}}) {
    expect_refusal(run("map make " + std::string(given) + lost), {error});
  }
}

TEST_F(Program, ATextInPlaceOfANumberIsToldThatANumberIsWanted) {
  expect_refusal(run("plan none.yaml --out o --time abc"),
                 {"regoplan: --time: abc is not valid (allowed: a number, above 0)"});
}

TEST_F(Program, ACountThatIsNoWholeNumberIsToldWithItsRange) {
  for (const auto& [command, option, allowed] :
       {std::tuple{"plan none.yaml --out o", "--iterations", "1 to 2000000000"},
        std::tuple{"plan none.yaml --out o", "--candidates", "1 to 100"},
        std::tuple{"demo", "--threads", "1 to 256"},
        std::tuple{"evaluate none.yaml none.csv --out o", "--draws", "2 to 1000000"},
        std::tuple{"evaluate none.yaml none.csv --out o", "--threads", "1 to 256"},
        std::tuple{"diagnose none.csv --out o", "--threads", "1 to 256"},
        std::tuple{"benchmark none.yaml --out o", "--processes", "1 to 256"},
        std::tuple{"map make --out o", "--soil-zones", "1 to 100"}}) {
    for (const std::string value :
         {"1e3", "2.5", "abc", "0", "-1", "nan", "99999999999999999999"}) {
      expect_refusal(run(std::string(command) + " " + option + "=" + value),
                     {std::string(option) + ": " + value +
                      " is not valid (allowed: a whole number, " + allowed + ")"});
    }
    expect_refusal(run(std::string(command) + " " + option + " ''"),
                   {std::string(option) + ": \"\" is not valid"});
  }
}

TEST_F(Program, AnUnknownOptionIsNamedWhateverFollowsIt) {
  expect_refusal(run("map make --craters -5 --out o"),
                 {"unknown option --craters (regoplan map make --help)"});
  expect_refusal(run("plan --iteratons 4 s.yaml --out o"),
                 {"unknown option --iteratons (did you mean --iterations? regoplan plan --help)"});
  // What seems to be missing then is not.
  expect_refusal(run("plan s.yaml --outt o"),
                 {"unknown option --outt (did you mean --out? regoplan plan --help)"});
  expect_refusal(run("evaluate s.yaml --folower=pursuit --out o"),
                 {"unknown option --folower (did you mean --follower? regoplan evaluate --help)"});
}

TEST_F(Program, AFaultThatDiagnoseNamesIsToldWithItsColumnsAndUnits) {
  const ProgramRun gain = run("mechanisms sensor_gain");
  EXPECT_EQ(gain.status, 0) << gain.errors;
  for (const char* words : {"an instrument", "told = (1 + gain) true", "fx_n, fy_n, torque_nm",
                            "settling_time_s unit: s"}) {
    EXPECT_NE(gain.output.find(words), std::string::npos) << words << " in: " << gain.output;
  }
  // Those that docs/drive-diagnosis.md lists as faults of a vehicle and its map.
  for (const char* id :
       {"wheel_drag", "side_drag", "steering_offset", "wheel_radius", "clock_offset", "payload",
        "motor_constant", "cg_offset", "tow_drag", "wheel_law", "map_offset", "map_heights",
        "zone_border", "attitude_mounting"}) {
    const ProgramRun told = run(std::string("mechanisms --json ") + id);
    EXPECT_EQ(told.status, 0) << told.errors;
    const auto names = nlohmann::json::parse(told.output);
    for (const auto& number : names.at(0).at("parameters")) {
      EXPECT_TRUE(number.at("unit") != "" || std::string(number.at("name")).ends_with("share"));
    }
  }
  EXPECT_NE(run("mechanisms").output.find("sensor_gain"), std::string::npos);
  const auto all = nlohmann::json::parse(run("mechanisms --json").output);
  EXPECT_EQ(schema("mechanisms").errors(all), std::vector<std::string>());
  std::set<std::string> listed;
  for (const auto& entry : all) listed.insert(entry.at("id").get<std::string>());
  for (const OtherName& other : other_names()) EXPECT_TRUE(listed.contains(std::string(other.id)));
  for (const MechanismForm& form : mechanism_forms()) {
    EXPECT_TRUE(listed.contains(std::string(form.id)));
  }
  expect_refusal(run("mechanisms stickiness"),
                 {"stickiness is not known (known: ", "grousers", "sensor_gain"});
}

TEST_F(Program, AMisspeltMechanismIsToldTheLikeliest) {
  for (const std::string misspelt : {"slipsinkage", "SLIP_SINKAGE", "slip_sinkige"}) {
    expect_refusal(run("mechanisms " + misspelt),
                   {misspelt + " is not known (did you mean slip_sinkage?)"});
  }
  expect_refusal(run("mechanisms sensor_gainn"), {"did you mean sensor_gain?"});
  // "none" is a word of rankings and no mechanism that anybody looks for.
  expect_refusal(run("mechanisms nope"), {"nope is not known (known: ", "grousers"});
}

TEST_F(Program, AMechanismWithoutANameIsRefused) {
  for (const std::string json : {"", " --json"}) {
    expect_refusal(run("mechanisms ''" + json), {"ID: empty, names no mechanism"});
  }
}

TEST_F(Program, APlanSaysWhereItsTimeWentBeforeTheSearchWhereThatIsMuch) {
  write_flat_scenario(folder_);
  const auto plan = [&](const std::string& budget) {
    return run("plan" + quoted("scenario.yaml") + "--out" + quoted("out") + budget).output;
  };
  const std::string line = "s went before the search: reading the scenario and its map ";
  // A program takes longer than a ten thousandth of a second to start.
  const std::string hurried = plan("--time 0.001");
  EXPECT_NE(hurried.find("Of 0.001 s, "), std::string::npos) << hurried;
  EXPECT_NE(hurried.find(line), std::string::npos) << hurried;
  EXPECT_EQ(plan("--iterations 20").find(line), std::string::npos);
  const auto json = nlohmann::json::parse(folder_.read("out/plan.json"));
  EXPECT_EQ(json.at("before_search").at(0).at("step"), "reading the scenario and its map");
  EXPECT_GT(json.at("before_search").at(0).at("time_s"), 0);
}

}  // namespace
}  // namespace regoplan
