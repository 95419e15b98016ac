#include "app/plan/demo_scenario.h"

#include <numbers>

#include "app/io/share_files.h"
#include "app/settings/soil_settings.h"
#include "maps/synthetic_terrain.h"

namespace regoplan {

PlanningProblem demo_problem(const ScenarioOverrides& overrides) {
  SyntheticTerrain terrain = make_synthetic_terrain(
      {.seed = 1, .width_m = 200, .height_m = 200, .cell_m = 0.5, .soil_zones = 3});
  SoilCatalogue soils = read_soil_catalogue(read_settings(share_file("scenarios/demo/soils.yaml")),
                                            WheelVariant::kIshigami2007);
  Vehicle vehicle = preset_vehicle("lrv");
  const Limits limits = default_limits(vehicle);
  PlanningProblem problem{
      .map = TerrainMap(std::move(terrain.elevation), std::move(terrain.classes), std::move(soils),
                        std::move(terrain.rocks)),
      .vehicle = std::move(vehicle),
      .wheel_variant = WheelVariant::kIshigami2007,
      .gravity_mps2 = 1.62,
      .start = {.x_m = 20, .y_m = 20, .heading_rad = std::numbers::pi / 4, .speed_mps = 0},
      .goal = {.x_m = 180, .y_m = 180, .radius_m = 3, .heading_rad = {}},
      .speed_max_mps = 3,
      .limits = limits,
      .search = overridden({}, overrides)};
  validate(problem);
  return problem;
}

}  // namespace regoplan
