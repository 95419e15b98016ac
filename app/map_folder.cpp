#include "app/map_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "app/soil_settings.h"
#include "app/staged_files.h"
#include "maps/raster_files.h"
#include "terramech/input_error.h"

namespace regoplan {
namespace {

constexpr double kClearance_m = 4;
constexpr double kGoalRadius_m = 3;

bool is_free(const TerrainMap& map, double x_m, double y_m, double clearance_m) {
  const double here_m = map.height_m(x_m, y_m);
  if (std::isnan(here_m) || !map.soil_index(x_m, y_m)) return false;
  const double rise_max_m = clearance_m * std::tan(10 * std::numbers::pi / 180);
  for (int i = 0; i < 8; ++i) {
    const double angle_rad = i * std::numbers::pi / 4;
    const double height_m = map.height_m(x_m + clearance_m * std::cos(angle_rad),
                                         y_m + clearance_m * std::sin(angle_rad));
    if (!(std::abs(height_m - here_m) < rise_max_m)) return false;
  }
  return std::ranges::none_of(map.rocks(), [&](const Rock& rock) {
    return std::hypot(rock.x_m - x_m, rock.y_m - y_m) < rock.radius_m + clearance_m;
  });
}

/// The stub has start and goal at one tenth and nine tenths of the map's diagonal.
std::string stub_text(const TerrainMap& map, const ScenarioStub& stub) {
  const GridFrame& frame = map.elevation().frame;
  const auto place = [&](double share) {
    const double x_m = frame.west_m + share * (frame.east_m() - frame.west_m);
    const double y_m = frame.south_m() + share * (frame.north_m - frame.south_m());
    const auto found = free_place_near(map, x_m, y_m, kClearance_m);
    if (!found) throw InputError("no place on the map is flat, free of rocks and on known soil");
    return *found;
  };
  const auto [start_x_m, start_y_m] = place(0.1);
  const auto [goal_x_m, goal_y_m] = place(0.9);
  const double heading_deg =
      std::round(std::atan2(goal_y_m - start_y_m, goal_x_m - start_x_m) * 180 / std::numbers::pi);
  return fmt::format(
             "# A scenario to go on from: set start, goal, vehicle and limits.\n"
             "map:\n  elevation: dem.tif\n{}  soils: soils.yaml\n{}",
             map.classes() ? "  soil_class: classes.tif\n" : "",
             map.rocks().empty() ? "" : "  rocks: rocks.csv\n") +
         fmt::format(
             "vehicle: {}\n"
             "gravity_mps2: {}\n"
             "start: {{x_m: {:.2f}, y_m: {:.2f}, heading_deg: {}, speed_mps: 0}}\n"
             "goal: {{x_m: {:.2f}, y_m: {:.2f}, radius_m: {}}}\n"
             "planner: {{name: auto, time_s: 20, seed: 1, candidates: 5}}\n",
             quoted_text(stub.vehicle), stub.gravity_mps2, start_x_m, start_y_m, heading_deg,
             goal_x_m, goal_y_m, kGoalRadius_m);
}

}  // namespace

std::optional<std::pair<double, double>> free_place_near(const TerrainMap& map, double x_m,
                                                         double y_m, double clearance_m) {
  const GridFrame& frame = map.elevation().frame;
  const double step_m = std::max({frame.cell_width_m, frame.cell_height_m, 1.0});
  const double reach_m = std::hypot(frame.east_m() - frame.west_m, frame.north_m - frame.south_m());
  for (int ring = 0; ring * step_m <= reach_m; ++ring) {
    const double radius_m = ring * step_m;
    const int places = 1 + static_cast<int>(2 * std::numbers::pi * radius_m / step_m);
    for (int i = 0; i < places; ++i) {
      const double angle_rad = 2 * std::numbers::pi * i / places;
      const double x = x_m + radius_m * std::cos(angle_rad);
      const double y = y_m + radius_m * std::sin(angle_rad);
      if (is_free(map, x, y, clearance_m)) return std::pair{x, y};
    }
  }
  return {};
}

void write_map_folder(const TerrainMap& map, const ScenarioStub& stub,
                      const std::filesystem::path& folder) {
  const std::string scenario = stub_text(map, stub);
  StagedFiles staged(folder);
  write_elevation(map.elevation(), staged.path("dem.tif"));
  if (map.classes()) write_classes(*map.classes(), staged.path("classes.tif"));
  if (!map.rocks().empty()) write_rocks(map.rocks(), staged.path("rocks.csv"));
  staged.write({.name = "soils.yaml", .content = soil_catalogue_text(map.catalogue())});
  staged.write({.name = "scenario.yaml", .content = scenario});
  staged.commit();
}

}  // namespace regoplan
