#include "app/settings/scenario_settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <thread>

#include "app/settings/carried_mechanisms.h"
#include "app/settings/map_notices.h"
#include "app/settings/model_settings.h"
#include "app/settings/settings_mapping.h"
#include "app/settings/settings_path.h"
#include "app/settings/soil_settings.h"
#include "app/settings/terrain_settings.h"
#include "app/settings/vehicle_settings.h"
#include "maps/raster_files.h"
#include "terramech/basics/angles.h"
#include "terramech/parameters/gravity_range.h"

namespace regoplan {
namespace {

constexpr ValueRange kHeading_deg{.min = -360, .max = 360};

StartState read_start(const SettingsNode& node) {
  return read_mapping(node, [](SettingsMapping& mapping) {
    return StartState{.x_m = mapping.number("x_m", kAnyNumber),
                      .y_m = mapping.number("y_m", kAnyNumber),
                      .heading_rad = mapping.number("heading_deg", kHeading_deg) * kDegree,
                      .speed_mps = mapping.number_or("speed_mps", kAtLeast0, 0)};
  });
}

/// At most the scenario's.
double read_goal_speed_max(const SettingsNode& node, double speed_max_mps) {
  return read_mapping(node, [speed_max_mps](SettingsMapping& mapping) {
    return mapping.number("max", {.min = 0, .max = speed_max_mps});
  });
}

Goal read_goal(const SettingsNode& node, double speed_max_mps) {
  return read_mapping(node, [speed_max_mps](SettingsMapping& mapping) {
    Goal goal;
    goal.x_m = mapping.number("x_m", kAnyNumber);
    goal.y_m = mapping.number("y_m", kAnyNumber);
    goal.radius_m = mapping.number("radius_m", kAnyNumber);  // how large it may be, the map says
    const SettingsNode* heading = mapping.optional("heading_deg");
    const SettingsNode* tolerance = mapping.optional("heading_tolerance_deg");
    if (!heading != !tolerance) {
      throw mapping.node().error("heading_deg and heading_tolerance_deg go together");
    }
    if (heading) {
      goal.heading_rad = heading->number(kHeading_deg) * kDegree;
      goal.heading_tolerance_rad =
          tolerance->number({.min = 0, .max = 180, .min_excluded = true}) * kDegree;
    }
    if (const SettingsNode* speed = mapping.optional("speed_mps")) {
      goal.speed_max_mps = read_goal_speed_max(*speed, speed_max_mps);
    }
    return goal;
  });
}

Objective read_objective(const SettingsNode& node) {
  return read_mapping(node, [](SettingsMapping& mapping) {
    const Objective defaults;
    return Objective{
        .per_s = mapping.number_or("per_s", kAtLeast0, 0),
        .per_m = mapping.number_or("per_m", kAtLeast0, 0),
        .per_j = mapping.number_or("per_j", kAtLeast0, 0),
        .per_exposed_s = mapping.number_or("per_exposed_s", kAtLeast0, 0),
        .exposed_below = mapping.number_or("exposed_below", kAbove0, defaults.exposed_below)};
  });
}

Search read_search(const SettingsNode& node) {
  return read_mapping(node, [](SettingsMapping& mapping) {
    Search search;
    if (const SettingsNode* name = mapping.optional("name")) {
      search.planner = planner_names()[name->choice(planner_names())];
    }
    if (const SettingsNode* objective = mapping.optional("objective")) {
      search.objective = read_objective(*objective);
    }
    const SettingsNode* time = mapping.optional("time_s");
    const SettingsNode* iterations = mapping.optional("iterations");
    if (time && iterations) throw iterations->error("either time_s or iterations, not both");
    if (time) search.time_s = time->number(kAbove0);
    if (iterations) search.iterations = iterations->integer(1, kIterationsMax);
    if (const SettingsNode* seed = mapping.optional("seed")) {
      search.seed = static_cast<std::uint64_t>(seed->integer(0, kSeedMax));
    }
    const auto count = [&mapping](const char* key, int most, int fallback) {
      const SettingsNode* given = mapping.optional(key);
      return given ? static_cast<int>(given->integer(1, most)) : fallback;
    };
    search.candidates = count("candidates", 100, search.candidates);
    search.soil_draws = count("soil_draws", 100000, search.soil_draws);
    if (const SettingsNode* improve = mapping.optional("improve"))
      search.improve = improve->truth();
    return search;
  });
}

/// Whether a model says more than soil numbers: then it need not name a soil of the map.
bool has_mechanisms(const ModelSettings& model) {
  return !model.spec.mechanisms.empty() || model.spec.generic.has_value();
}

/// The map's soils with the one that the model names replaced by the model's.
TerrainMap with_model_soil(const TerrainMap& map, const ModelSettings& model,
                           const std::string& model_file) {
  if (!model.soil_name && has_mechanisms(model)) return map;
  if (!model.soil_name) {
    throw SettingsError(
        fmt::format("{}: soil_name is missing: it says which soil of the map these numbers replace",
                    model_file));
  }
  std::vector<MapSoil> soils = map.soils();
  const auto soil = std::ranges::find(soils, *model.soil_name, &MapSoil::name);
  if (soil == soils.end()) {
    std::vector<std::string> names;
    names.reserve(soils.size());
    for (const MapSoil& known : soils) names.push_back(known.name);
    throw SettingsError(fmt::format("{}: soil_name: {} is no soil of the map (it has: {})",
                                    model_file, *model.soil_name, fmt::join(names, ", ")));
  }
  soil->soil = model.soil;
  soil->source = model_file;
  return map.with_soils(std::move(soils));
}

double read_speed_max(const SettingsNode& node, const Vehicle& vehicle) {
  return read_mapping(node, [&vehicle](SettingsMapping& mapping) {
    return mapping.number("max", {.min = 0, .max = vehicle.speed_max_mps, .min_excluded = true});
  });
}

Vehicle read_scenario_vehicle(const SettingsNode& node, const std::filesystem::path& folder) {
  return node.kind() == SettingsNode::Kind::kMapping ? read_vehicle(node)
                                                     : named_vehicle(node, folder);
}

/// \param classes_shown, rocks_shown what its classes and rocks stand in
ScenarioMap with_notices(ScenarioMap map, const std::string& classes_shown,
                         const std::string& rocks_shown) {
  for (const std::string& notice :
       {unlisted_classes_notice(map.map, classes_shown), uncovered_notice(map.map, classes_shown),
        rocks_off_map_notice(map.map, rocks_shown)}) {
    if (!notice.empty()) map.notices.push_back(notice);
  }
  return map;
}

/// The files of a scenario beside those of its map.
std::vector<InputFile> inputs_of(const std::string& file, const SettingsNode& vehicle,
                                 const std::filesystem::path& folder,
                                 const ScenarioOverrides& overrides) {
  std::vector<InputFile> inputs{{.key = "scenario", .path = file, .shown = file}};
  if (vehicle.kind() != SettingsNode::Kind::kMapping) {
    const std::vector<std::string> presets = preset_vehicle_names();
    if (std::ranges::find(presets, vehicle.text()) == presets.end()) {
      const NamedFile named = named_file(vehicle, folder);
      inputs.push_back({.key = vehicle.path(), .path = named.path, .shown = named.shown});
    }
  }
  if (overrides.model_file) {
    inputs.push_back(
        {.key = "model", .path = *overrides.model_file, .shown = *overrides.model_file});
  }
  return inputs;
}

std::string unread_rocks_notice(const SettingsNode& map) {
  return fmt::format(
      "{}:{}: {}: rocks.csv lies beside it and is not read; remedy, where its rocks stand on this "
      "map: rocks: rocks.csv",
      map.file(), map.line(), map.path());
}

}  // namespace

Search overridden(Search search, const ScenarioOverrides& overrides) {
  if (overrides.planner) search.planner = *overrides.planner;
  if (overrides.seed) search.seed = *overrides.seed;
  if (overrides.improve) search.improve = *overrides.improve;
  if (overrides.candidates) search.candidates = *overrides.candidates;
  if (overrides.time_s || overrides.iterations) {
    search.time_s = overrides.time_s;
    search.iterations = overrides.iterations;
  }
  if (!search.time_s && !search.iterations) search.time_s = kSearchTimeDefault_s;
  search.threads = overrides.threads.value_or(
      std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, kThreadsMax));
  return search;
}

ScenarioMap read_map(const SettingsNode& node, const std::filesystem::path& folder,
                     WheelVariant variant, std::optional<double> wheel_width_m) {
  return read_mapping(node, [&](SettingsMapping& mapping) {
    std::vector<InputFile> inputs;
    const auto read_named = [&](const SettingsNode& name, auto read) {
      return placed(name, [&] {
        return with_named_file(name, folder, [&](const NamedFile& file) {
          inputs.push_back({.key = name.path(), .path = file.path, .shown = file.shown});
          return read(file);
        });
      });
    };
    std::vector<std::string> notices;

    const SettingsNode& soils = mapping.required("soils");
    const auto read_soils = [&](const SettingsNode& given) {
      SoilCatalogue catalogue = read_soil_catalogue(given, variant);
      if (wheel_width_m) require_resistance(given, catalogue, *wheel_width_m);
      std::ranges::move(doubtful_units(given, catalogue), std::back_inserter(notices));
      return catalogue;
    };
    SoilCatalogue catalogue = soils.kind() == SettingsNode::Kind::kMapping
                                  ? read_soils(soils)
                                  : read_named(soils, [&](const NamedFile& file) {
                                      if (!std::filesystem::exists(file.path)) {
                                        throw InputError(file.path.string() + ": no such file");
                                      }
                                      return read_soils(read_settings(file.path.string()));
                                    });

    if (const SettingsNode* drawn = mapping.optional("terrain")) {
      SyntheticTerrain terrain = placed(*drawn, [&] { return draw_terrain(read_terrain(*drawn)); });
      const std::string shown =
          fmt::format("{}:{}: {}", drawn->file(), drawn->line(), drawn->path());
      return with_notices(
          {.map = TerrainMap(std::move(terrain.elevation), std::move(terrain.classes),
                             std::move(catalogue), std::move(terrain.rocks)),
           .notices = std::move(notices),
           .inputs = std::move(inputs)},
          shown, shown);
    }
    const SettingsNode& elevation_file = mapping.required("elevation");
    ElevationRaster elevation = read_named(
        elevation_file, [](const NamedFile& file) { return read_elevation(file.path.string()); });

    std::optional<ClassRaster> classes;
    std::string classes_shown;
    if (const SettingsNode* name = mapping.optional("soil_class")) {
      read_named(*name, [&](const NamedFile& file) {
        classes_shown = file.shown.string();
        classes = read_classes(file.path.string());
        std::string notice = adopt_crs(*classes, elevation.frame, file.shown.string());
        if (!notice.empty()) notices.push_back(std::move(notice));
        return true;
      });
    } else if (catalogue.soils.size() != 1) {
      throw soils.error(
          fmt::format("{} soils (allowed without soil_class: one)", catalogue.soils.size()));
    }

    std::vector<Rock> rocks;
    std::string rocks_shown;
    if (const SettingsNode* name = mapping.optional("rocks")) {
      rocks = read_named(*name, [&](const NamedFile& file) {
        rocks_shown = file.shown.string();
        return read_rocks(file.path.string(), elevation.frame);
      });
    } else if (std::filesystem::exists(folder / "rocks.csv")) {
      notices.push_back(unread_rocks_notice(node));
    }
    return with_notices({.map = TerrainMap(std::move(elevation), std::move(classes),
                                           std::move(catalogue), std::move(rocks)),
                         .notices = std::move(notices),
                         .inputs = std::move(inputs)},
                        classes_shown, rocks_shown);
  });
}

Limits read_limits(const SettingsNode& node, const Limits& defaults) {
  return read_mapping(node, [&defaults](SettingsMapping& mapping) {
    Limits limits = defaults;
    for (const LimitKey& limit : limit_keys()) {
      const SettingsNode* given = mapping.optional(limit.key);
      if (given) limits.*limit.value = given->number(limit.shown_range) * limit.si_per_shown;
    }
    return limits;
  });
}

Scenario read_scenario(const std::string& file, const ScenarioOverrides& overrides) {
  const SettingsNode root = read_settings(file);
  const std::filesystem::path folder = std::filesystem::path(file).parent_path();
  std::optional<ModelSettings> model;
  std::vector<std::string> model_notices;
  if (overrides.model_file) {
    model = read_model_file(*overrides.model_file);
    model_notices = leave_test_bed_behind(model->spec.mechanisms, *overrides.model_file);
    // Without a name its soil numbers count nowhere.
    if (model->soil_name) std::ranges::copy(model->warnings, std::back_inserter(model_notices));
  }
  const WheelVariant variant = model ? model->spec.variant : WheelVariant::kIshigami2007;

  return read_mapping(root, [&](SettingsMapping& mapping) {
    const SettingsNode& vehicle_node = mapping.required("vehicle");
    Vehicle vehicle =
        placed(vehicle_node, [&] { return read_scenario_vehicle(vehicle_node, folder); });
    const double gravity_mps2 = mapping.number("gravity_mps2", kGravity_mps2);
    const StartState start = read_start(mapping.required("start"));
    const SettingsNode& goal_node = mapping.required("goal");
    const SettingsNode* speed = mapping.optional("speed_mps");
    const double speed_max_mps = speed ? read_speed_max(*speed, vehicle) : vehicle.speed_max_mps;
    const Goal goal = read_goal(goal_node, speed_max_mps);
    const SettingsNode* limits = mapping.optional("limits");
    const SettingsNode* planner = mapping.optional("planner");
    const SettingsNode* expectation = mapping.optional("expectation");

    const Limits kept =
        limits ? read_limits(*limits, default_limits(vehicle)) : default_limits(vehicle);
    const Search search = overridden(planner ? read_search(*planner) : Search{}, overrides);
    ScenarioMap read = read_map(mapping.required("map"), folder, variant, vehicle.wheel.width_m);
    Scenario scenario{
        .problem = {.map = model ? with_model_soil(read.map, *model, *overrides.model_file)
                                 : std::move(read.map),
                    .vehicle = std::move(vehicle),
                    .wheel_variant = variant,
                    .mechanisms = model ? model->spec.mechanisms : std::vector<Mechanism>{},
                    .generic = model ? model->spec.generic : std::nullopt,
                    .gravity_mps2 = gravity_mps2,
                    .start = start,
                    .goal = goal,
                    .speed_max_mps = speed_max_mps,
                    .limits = kept,
                    .search = search},
        .notices = std::move(read.notices),
        .expectation = {},
        .inputs = inputs_of(file, vehicle_node, folder, overrides)};
    std::ranges::move(read.inputs, std::back_inserter(scenario.inputs));
    if (expectation) {
      scenario.expectation = expectation->choice({"feasible", "infeasible"}) == 0
                                 ? PlanStatus::kFeasible
                                 : PlanStatus::kInfeasible;
    }
    std::ranges::move(model_notices, std::back_inserter(scenario.notices));
    if (model && !model->soil_name) {
      scenario.notices.push_back(fmt::format(
          "{}: no soil_name: its mechanisms count on every soil, its soil numbers on none",
          *overrides.model_file));
    }
    validate(scenario.problem);
    for (std::string& notice : map_notices(scenario.problem.map, scenario.problem.vehicle)) {
      scenario.notices.push_back(std::move(notice));
    }
    return scenario;
  });
}

ScenarioMap read_scenario_map(const std::string& file) {
  const SettingsNode root = read_settings(file);
  const SettingsNode* map = root.find("map");
  if (!map) throw root.error("map is missing");
  return read_map(*map, std::filesystem::path(file).parent_path(), WheelVariant::kIshigami2007);
}

}  // namespace regoplan
