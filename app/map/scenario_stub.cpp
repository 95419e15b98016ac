#include "app/map/scenario_stub.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <numbers>

#include "app/settings/soil_settings.h"
#include "app/settings/vehicle_settings.h"
#include "planner/problem/world.h"
#include "terramech/basics/angles.h"
#include "terramech/basics/input_error.h"

namespace regoplan {
namespace {

struct StubVehicle {
  Vehicle vehicle;
  std::string name;  ///< in the scenario
  std::optional<RenderedFile> file;
};

StubVehicle vehicle_of(const std::string& given) {
  const std::vector<std::string> presets = preset_vehicle_names();
  if (std::ranges::find(presets, given) != presets.end()) {
    return {.vehicle = preset_vehicle(given), .name = given, .file = {}};
  }
  StubVehicle read{
      .vehicle = read_vehicle(read_settings(given)), .name = "vehicle.yaml", .file = {}};
  std::ifstream stream(given, std::ios::binary);
  read.file = RenderedFile{.name = read.name,
                           .content = std::string(std::istreambuf_iterator<char>(stream), {})};
  return read;
}

struct Place {
  double x_m = 0, y_m = 0;
};

/// As it stands in the scenario.
Place rounded(Place place) {
  const auto to_cm = [](double value_m) { return std::round(100 * value_m) / 100; };
  return {to_cm(place.x_m), to_cm(place.y_m)};
}

double heading_deg(const Place& from, const Place& to) {
  return std::round(std::atan2(to.y_m - from.y_m, to.x_m - from.x_m) / kDegree) + 0.0;  // never -0
}

/// The place nearest to `wanted`, ring by ring, of which `may` holds; nothing where the map has
/// none.
std::optional<Place> nearest_place(const GridFrame& frame, const Place& wanted,
                                   const std::function<bool(const Place&)>& may) {
  const double reach_m = std::hypot(frame.east_m() - frame.west_m, frame.north_m - frame.south_m());
  constexpr double kOfReach = 1.0 / 30, kMost_m = 1;
  const double step_m =
      std::max({frame.cell_width_m, frame.cell_height_m, std::min(kMost_m, kOfReach * reach_m)});
  for (int ring = 0; ring * step_m <= reach_m; ++ring) {
    const double radius_m = ring * step_m;
    const int places = 1 + static_cast<int>(2 * std::numbers::pi * radius_m / step_m);
    for (int i = 0; i < places; ++i) {
      const double angle_rad = 2 * std::numbers::pi * i / places;
      const Place place = rounded({wanted.x_m + radius_m * std::cos(angle_rad),
                                   wanted.y_m + radius_m * std::sin(angle_rad)});
      if (covers(frame, place.x_m, place.y_m) && may(place)) return place;
    }
  }
  return {};
}

/// Where a vehicle can stand on a map.
class StandingGround {
 public:
  StandingGround(const TerrainMap& map, const Vehicle& vehicle, double gravity_mps2)
      : problem_(problem(map, vehicle, gravity_mps2)), world_(problem_, WorldUse::kVerdict, 1) {}

  /// By the planner's verdict, at rest.
  bool stands(const Place& place, double heading_deg) {
    const TerrainMap& map = problem_.map;
    if (std::isnan(map.height_m(place.x_m, place.y_m)) || !map.soil_index(place.x_m, place.y_m)) {
      ++refused_[static_cast<std::size_t>(Rejection::kUnknownTerrain)];
      return false;
    }
    const VehicleState state =
        world_.dynamics().rolling_state(place.x_m, place.y_m, heading_deg * kDegree, 0);
    const auto rejection = world_.rejected(state, {});
    if (rejection) ++refused_[static_cast<std::size_t>(rejection->reason)];
    return !rejection;
  }

  /// Level ground without rocks around.
  bool has_room(const Place& place) const {
    constexpr double kAround_m = 4;
    const TerrainMap& map = problem_.map;
    const double here_m = map.height_m(place.x_m, place.y_m);
    if (std::isnan(here_m)) return false;
    const double rise_max_m = kAround_m * std::tan(10 * kDegree);
    for (int i = 0; i < 8; ++i) {
      const double angle_rad = i * std::numbers::pi / 4;
      const double height_m = map.height_m(place.x_m + kAround_m * std::cos(angle_rad),
                                           place.y_m + kAround_m * std::sin(angle_rad));
      if (!(std::abs(height_m - here_m) < rise_max_m)) return false;
    }
    return !map.any_rock(place.x_m - kAround_m, place.x_m + kAround_m, place.y_m - kAround_m,
                         place.y_m + kAround_m, [&](const Rock& rock) {
                           return std::hypot(rock.x_m - place.x_m, rock.y_m - place.y_m) <
                                  rock.radius_m + kAround_m;
                         });
  }

  /// What most places were refused for.
  std::string_view usual_refusal() const {
    return name(static_cast<Rejection>(std::ranges::max_element(refused_) - refused_.begin()));
  }

 private:
  static PlanningProblem problem(const TerrainMap& map, const Vehicle& vehicle,
                                 double gravity_mps2) {
    Limits limits = default_limits(vehicle);
    constexpr double kShare = 0.9;  // so that a search, which keeps a reserve, may begin there
    limits.slope_max_rad *= kShare;
    return {.map = map,
            .vehicle = vehicle,
            .gravity_mps2 = gravity_mps2,
            .start = {},
            .goal = {},
            .speed_max_mps = vehicle.speed_max_mps,
            .limits = limits,
            .search = {}};
  }

  PlanningProblem problem_;
  World world_;
  std::array<std::int64_t, kRejectionCount> refused_{};
};

struct StartAndGoal {
  Place start, goal;
};

StartAndGoal start_and_goal(const TerrainMap& map, const StubVehicle& vehicle,
                            double gravity_mps2) {
  const GridFrame& frame = map.elevation().frame;
  const auto on_diagonal = [&](double share) {
    return Place{frame.west_m + share * (frame.east_m() - frame.west_m),
                 frame.south_m() + share * (frame.north_m - frame.south_m())};
  };
  const Place wanted_start = on_diagonal(0.1), wanted_goal = on_diagonal(0.9);
  StandingGround ground(map, vehicle.vehicle, gravity_mps2);
  for (const bool roomy : {true, false}) {
    const auto may = [&](const Place& place, double heading_deg) {
      return (!roomy || ground.has_room(place)) && ground.stands(place, heading_deg);
    };
    const auto goal = nearest_place(frame, wanted_goal, [&](const Place& place) {
      return may(place, heading_deg(wanted_start, place));
    });
    if (!goal) continue;
    const auto start = nearest_place(frame, wanted_start, [&](const Place& place) {
      return may(place, heading_deg(place, *goal));
    });
    if (start) return {*start, *goal};
  }
  throw InputError(fmt::format(
      "the {} can stand nowhere on the map, most often because of: {}; remedy: another --vehicle, "
      "or heights and cells in their right units",
      vehicle.vehicle.name, ground.usual_refusal()));
}

/// About as far as the vehicle is long, and well within the way there: a goal that holds the start
/// leaves nothing to plan.
double goal_radius_m(const Vehicle& vehicle, const StartAndGoal& ends) {
  constexpr double kMost_m = 3, kLeast_m = 0.05, kShareOfWay = 0.2;
  const double way_m = std::hypot(ends.goal.x_m - ends.start.x_m, ends.goal.y_m - ends.start.y_m);
  const double radius_m =
      std::min({kMost_m, vehicle.body.x_max_m - vehicle.body.x_min_m, kShareOfWay * way_m});
  return std::max(kLeast_m, std::floor(20 * radius_m) / 20);
}

}  // namespace

Vehicle stub_vehicle(const ScenarioStub& stub) {
  return vehicle_of(stub.vehicle).vehicle;
}

StubFiles stub_files(const TerrainMap& map, const ScenarioStub& stub) {
  StubVehicle vehicle = vehicle_of(stub.vehicle);
  const StartAndGoal ends = start_and_goal(map, vehicle, stub.gravity_mps2);
  const auto [start, goal] = ends;
  std::string text = "# A scenario to go on from: set start, goal, vehicle and limits.\n";
  text += fmt::format("map:\n  elevation: dem.tif\n{}  soils: soils.yaml\n{}",
                      map.classes() ? "  soil_class: classes.tif\n" : "",
                      map.rocks().empty() ? "" : "  rocks: rocks.csv\n");
  text += fmt::format(
      "vehicle: {}\n"
      "gravity_mps2: {}\n"
      "start: {{x_m: {:.2f}, y_m: {:.2f}, heading_deg: {}, speed_mps: 0}}\n"
      "goal: {{x_m: {:.2f}, y_m: {:.2f}, radius_m: {}}}\n"
      "planner: {{name: auto, time_s: 20, seed: 1, candidates: 5}}\n",
      quoted_text(vehicle.name), stub.gravity_mps2, start.x_m, start.y_m, heading_deg(start, goal),
      goal.x_m, goal.y_m, goal_radius_m(vehicle.vehicle, ends));
  return {.scenario = {.name = "scenario.yaml", .content = std::move(text)},
          .vehicle = std::move(vehicle.file)};
}

}  // namespace regoplan
