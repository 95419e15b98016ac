// `map import` as a person meets it: what goes in, and the scenario that comes out.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "app/settings/scenario_settings.h"
#include "app/settings/vehicle_settings.h"
#include "planner/problem/world.h"
#include "tests/app/flat_map.h"
#include "tests/app/program_run.h"
#include "tests/error_text.h"

namespace regoplan {
namespace {

class MapImport : public testing::Test {
 protected:
  MapImport() { folder_.write("soils.yaml", kOneSoil); }

  void write_elevations(const std::function<double(double x_m, double y_m)>& height_m,
                        double cell_m = 1) const {
    ElevationRaster raster = flat_elevation();
    raster.frame.cell_width_m = raster.frame.cell_height_m = cell_m;
    raster.frame.north_m = 40 * cell_m;
    for (int i = 0; i < 1600; ++i) {
      raster.height_m[static_cast<std::size_t>(i)] = static_cast<float>(
          height_m((i % 40 + 0.5) * cell_m, (39.5 - static_cast<double>(i / 40)) * cell_m));
    }
    write_elevation(raster, folder_.path("dem.tif"));
  }

  ProgramRun import(const std::string& more, const std::string& elevation = "dem.tif") const {
    return run_program(folder_, "map import --gravity-mps2 1.62 --elevation '" +
                                    folder_.path(elevation) + "' --soils '" +
                                    folder_.path("soils.yaml") + "' --out '" + folder_.path("map") +
                                    "' " + more);
  }

  /// What the planner thinks of the start of the scenario that was written.
  std::optional<RejectedState> rejection_of_start() const {
    const Scenario scenario = read_scenario(folder_.path("map/scenario.yaml"), {});
    const World world(scenario.problem, WorldUse::kVerdict, 1);
    return world.rejected(world.start(), {});
  }

  ScratchFolder folder_;
};

double flat_ground(double /*x_m*/, double /*y_m*/) {
  return 0.25;
}

TEST_F(MapImport, AVehicleFileThatIsMissingIsRefusedAndNothingIsWritten) {
  write_elevations(flat_ground);
  const ProgramRun run = import("--vehicle nowhere.yaml");
  expect_refusal(run,
                 {"--vehicle: nowhere.yaml is not valid", "lrv", "a vehicle file that exists"});
  EXPECT_FALSE(std::filesystem::exists(folder_.path("map")));
}

TEST_F(MapImport, AVehicleFileIsCopiedBesideTheMapAndTheScenarioReadsIt) {
  write_elevations(flat_ground);
  Vehicle mine = preset_vehicle("curiosity");
  mine.name = "my rover";
  const std::string text = "# measured\n" + vehicle_text(mine);
  const ProgramRun run = import("--vehicle '" + folder_.write("mine.yaml", text) + "'");
  ASSERT_EQ(run.status, 0) << run.errors;
  std::filesystem::remove(folder_.path("mine.yaml"));
  EXPECT_EQ(folder_.read("map/vehicle.yaml"), text);
  EXPECT_EQ(read_scenario(folder_.path("map/scenario.yaml"), {}).problem.vehicle.name, "my rover");
}

TEST_F(MapImport, AVehicleFileWithAFaultIsRefused) {
  write_elevations(flat_ground);
  const std::string bad = folder_.write("bad.yaml", "name: x\n");
  expect_refusal(import("--vehicle '" + bad + "'"), {"bad.yaml", "is missing"});
}

TEST_F(MapImport, TheStartStandsWhereThePlannerLetsTheVehicleStand) {
  // Steep but for a terrace of 9 m, which no clear circle of 4 m radius with rocks on it fits.
  write_elevations([](double x_m, double /*y_m*/) {
    return x_m < 14 ? x_m : x_m < 23 ? 14 : x_m - 9;
  });
  std::string rocks = "x_m,y_m,radius_m,height_m\n";
  for (int i = 0; i < 8; ++i) rocks += "21," + std::to_string(5 * i + 2) + ".5,0.5,1\n";
  rocks += "90,5,1,1\n";
  folder_.write("rocks.csv", rocks);
  const ProgramRun run = import("--rocks '" + folder_.path("rocks.csv") + "'");
  ASSERT_EQ(run.status, 0) << run.errors;
  EXPECT_NE(run.errors.find("rocks.csv: 1 of 9 rocks lies wholly off the map"), std::string::npos)
      << run.errors;
  const auto rejection = rejection_of_start();
  EXPECT_FALSE(rejection) << name(rejection->reason);
}

TEST_F(MapImport, TheGoalFitsASmallMapAndASmallVehicle) {
  write_elevations(flat_ground, 0.05);  // 2 m by 2 m
  const ProgramRun run = import("--vehicle tohoku");
  ASSERT_EQ(run.status, 0) << run.errors;
  const PlanningProblem problem = read_scenario(folder_.path("map/scenario.yaml"), {}).problem;
  EXPECT_NO_THROW(validate(problem));
  EXPECT_LT(problem.goal.radius_m, 0.5);
  EXPECT_GT(problem.goal.radius_m, 0.1);
}

TEST_F(MapImport, AUsualVehicleOnAUsualMapHasAGoalOfThreeMetres) {
  write_elevations(flat_ground);
  ASSERT_EQ(import("").status, 0);
  EXPECT_EQ(read_scenario(folder_.path("map/scenario.yaml"), {}).problem.goal.radius_m, 3);
}

TEST_F(MapImport, GroundFullOfHolesIsNoPlaceToStand) {
  write_elevations([](double x_m, double y_m) {
    return std::fmod(x_m, 2) < 1 && std::fmod(y_m, 2) < 1 ? std::nan("") : 0.25;
  });
  expect_refusal(import(""), {"can stand nowhere on the map", "unknown_terrain"});
}

TEST_F(MapImport, AMapOnWhichTheVehicleCanStandNowhereIsRefusedWithTheReason) {
  write_elevations([](double x_m, double /*y_m*/) { return 2 * x_m; });
  expect_refusal(import(""), {"can stand nowhere on the map", "slope"});
  EXPECT_FALSE(std::filesystem::exists(folder_.path("map")));
}

TEST_F(MapImport, RocksBesideTheMapAreRefusedWithTheirFileAndPlace) {
  write_elevations(flat_ground);
  folder_.write("rocks.csv", "x_m,y_m,radius_m,height_m\n\n400,30,1,2\n");
  expect_refusal(import("--rocks '" + folder_.path("rocks.csv") + "'"),
                 {"rocks.csv:3: x_m 400, y_m 30", "x 0 to 40 m, y 0 to 40 m"});
}

TEST_F(MapImport, SoilsThatNothingPlacesAreRefusedWithTheRemedy) {
  write_elevations(flat_ground);
  std::string soil = kOneSoil;
  soil = soil.substr(std::string("{soils: {mare: ").size());
  soil.resize(soil.size() - 2);
  folder_.write("soils.yaml", "soils:\n  mare: " + soil + "\n  dust: " + soil + "\n");
  expect_refusal(import(""), {"soils.yaml:1: soils: 2 soils", "--soil-class"});
}

TEST_F(MapImport, CellsWiderThanTheVehicleAreANoticeWithTheRemedy) {
  write_elevations(flat_ground, 5);
  const ProgramRun run = import("");
  EXPECT_EQ(run.status, 0);
  EXPECT_NE(run.errors.find("cells of 5 x 5 m are wider than the"), std::string::npos)
      << run.errors;
  EXPECT_NE(run.errors.find("remedy"), std::string::npos);
  write_elevations(flat_ground, 1);
  EXPECT_EQ(import("").errors, "");
}

TEST_F(MapImport, WholeMetresOnSmallCellsAreANotice) {
  write_elevations([](double x_m, double /*y_m*/) { return x_m < 30 ? 0 : 1; });
  const ProgramRun run = import("");
  EXPECT_EQ(run.status, 0);
  EXPECT_NE(run.errors.find("whole metres"), std::string::npos) << run.errors;
  EXPECT_NE(run.errors.find("--scale"), std::string::npos) << run.errors;
}

TEST_F(MapImport, ScaleOffsetAndNodataAreApplied) {
  write_elevations([](double x_m, double y_m) { return y_m > 39 ? -9999 : 100 + x_m; });
  expect_refusal(import(""), {"-9999", "--nodata -9999"});
  expect_refusal(import("--scale 0"), {"--scale: 0 is not valid"});
  const ProgramRun run = import("--scale 0.1 --offset -3 --nodata -9999");
  ASSERT_EQ(run.status, 0) << run.errors;
  const ElevationRaster map = read_elevation(folder_.path("map/dem.tif"));
  EXPECT_TRUE(std::isnan(map.height_m[0]));
  EXPECT_NEAR(map.height_m[40], 0.1 * 100.5 - 3, 1e-5);
}

TEST_F(MapImport, ATableOfPointsIsReadLikeARaster) {
  std::string table = "x,y,z\n";
  for (int x = 0; x < 40; ++x) {
    for (int y = 0; y < 40; ++y) {
      table += std::to_string(x) + ".5," + std::to_string(y) + ".5,0.25\n";
    }
  }
  folder_.write("grid.csv", table);
  const ProgramRun run = import("", "grid.csv");
  ASSERT_EQ(run.status, 0) << run.errors;
  const ElevationRaster map = read_elevation(folder_.path("map/dem.tif"));
  EXPECT_EQ(map.frame, flat_elevation().frame);
  EXPECT_EQ(map.height_m, std::vector<float>(1600, 0.25F));
}

}  // namespace
}  // namespace regoplan
