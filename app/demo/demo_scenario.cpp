#include "app/demo/demo_scenario.h"

#include <fmt/format.h>

#include <numbers>

#include "app/io/share_files.h"
#include "app/settings/soil_settings.h"
#include "maps/synthetic_terrain.h"
#include "terramech/basics/angles.h"

namespace regoplan {
namespace {

constexpr StartState kStart{
    .x_m = 20, .y_m = 20, .heading_rad = std::numbers::pi / 4, .speed_mps = 0};
constexpr double kGoal_m = 180, kGoalRadius_m = 3, kSpeedMax_mps = 3, kMoon_mps2 = 1.62;
constexpr const char* kVehicle = "lrv";

}  // namespace

PlanningProblem demo_problem(const ScenarioOverrides& overrides) {
  SyntheticTerrain terrain = make_synthetic_terrain(
      {.seed = 1, .width_m = 200, .height_m = 200, .cell_m = 0.5, .soil_zones = 3});
  SoilCatalogue soils = read_soil_catalogue(read_settings(share_file("scenarios/demo/soils.yaml")),
                                            WheelVariant::kIshigami2007);
  Vehicle vehicle = preset_vehicle(kVehicle);
  const Limits limits = default_limits(vehicle);
  PlanningProblem problem{
      .map = TerrainMap(std::move(terrain.elevation), std::move(terrain.classes), std::move(soils),
                        std::move(terrain.rocks)),
      .vehicle = std::move(vehicle),
      .wheel_variant = WheelVariant::kIshigami2007,
      .gravity_mps2 = kMoon_mps2,
      .start = kStart,
      .goal = {.x_m = kGoal_m, .y_m = kGoal_m, .radius_m = kGoalRadius_m, .heading_rad = {}},
      .speed_max_mps = kSpeedMax_mps,
      .limits = limits,
      .search = overridden({}, overrides)};
  validate(problem);
  return problem;
}

std::string demo_scenario_text() {
  return fmt::format(
      "# The built-in scenario of `regoplan demo`.\n"
      "map: {{elevation: dem.tif, soil_class: classes.tif, soils: soils.yaml, rocks: rocks.csv}}\n"
      "vehicle: {}\n"
      "gravity_mps2: {}\n"
      "start: {{x_m: {}, y_m: {}, heading_deg: {}}}\n"
      "goal: {{x_m: {}, y_m: {}, radius_m: {}}}\n"
      "speed_mps: {{max: {}}}\n",
      kVehicle, kMoon_mps2, kStart.x_m, kStart.y_m, degrees(kStart.heading_rad), kGoal_m, kGoal_m,
      kGoalRadius_m, kSpeedMax_mps);
}

}  // namespace regoplan
