#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

#include "app/command/command.h"
#include "app/command/plan_options.h"
#include "app/io/interrupt.h"
#include "app/io/share_files.h"
#include "app/io/staged_files.h"
#include "app/map/map_folder.h"
#include "app/map/map_summary.h"
#include "app/map/stub_options.h"
#include "app/settings/soil_settings.h"
#include "maps/synthetic_terrain.h"
#include "terramech/basics/input_error.h"
#include "terramech/parameters/vehicle.h"

namespace regoplan {
namespace {

struct MapMakeOptions {
  SyntheticTerrainSettings terrain;
  std::string soils = share_file("scenarios/demo/soils.yaml");
  ScenarioStub stub{.vehicle = "lrv", .gravity_mps2 = 1.62};
  std::vector<std::string> given;  ///< the options of the terrain that were
  ResultFolder out;
  bool json = false;
  bool quiet = false;
};

/// `cell_m` is given as `--cell-m`.
std::string option_name(std::string field) {
  std::ranges::replace(field, '_', '-');
  return "--" + field;
}

/// \param given options that stand on the command line
void require_valid(const SyntheticTerrainSettings& settings,
                   const std::vector<std::string>& given) {
  try {
    validate(settings);
  } catch (const ValueError& bad) {
    const std::string option = option_name(bad.field());
    if (given.empty() || std::ranges::find(given, option) != given.end()) {
      throw ValueError(option, bad.value(), bad.allowed());
    }
    // A default that does not go with what was given.
    throw InputError(fmt::format("{}: does not go with the default of {}; give that as well",
                                 fmt::join(given, ", "),
                                 ValueError(option, bad.value(), bad.allowed()).what()));
  }
}

ExitStatus run_map_make(const MapMakeOptions& options) {
  require_valid(options.terrain, options.given);  // before any file is read or made
  require_writable_folder(options.out);
  SoilCatalogue soils =
      read_soil_catalogue(read_settings(options.soils), WheelVariant::kIshigami2007);
  for (int code = 1; code <= options.terrain.soil_zones; ++code) {
    if (std::ranges::find(soils.classes, code, &std::pair<std::int32_t, int>::first) ==
        soils.classes.end()) {
      throw InputError(fmt::format("{}: classes: no soil for zone {} (--soil-zones {})",
                                   options.soils, code, options.terrain.soil_zones));
    }
  }
  require_results_fit(options.out, map_folder_names());
  SyntheticTerrain terrain = make_synthetic_terrain(options.terrain);
  const TerrainMap map(std::move(terrain.elevation), std::move(terrain.classes), std::move(soils),
                       std::move(terrain.rocks));
  if (!write_map_folder(map, options.stub, options.out, stop_on_interrupt())) return kInterrupted;
  print_map_written(map, options.out.path, options.json, options.quiet);
  return kYes;
}

}  // namespace

Command add_map_make_command(CLI::App& map) {
  const auto options = std::make_shared<MapMakeOptions>();
  CLI::App* parser = map.add_subcommand(
      "make",
      "Make a synthetic terrain: craters, rocks and zones of soil. Same settings, same terrain.\n"
      "Writes dem.tif, classes.tif, rocks.csv, soils.yaml and scenario.yaml.");
  parser->add_option("--out", options->out.path, "folder for the map")
      ->type_name("DIR")
      ->required();
  parser->add_option("--seed", options->terrain.seed, "seed of all random numbers")
      ->type_name("N")
      ->check(a_seed())
      ->capture_default_str();
  const auto number = [&](const char* name, double SyntheticTerrainSettings::*member,
                          const char* help) {
    parser->add_option(name, options->terrain.*member, help)
        ->type_name("NUMBER")
        ->check(in_range(kAnyNumber))
        ->capture_default_str();
  };
  using Settings = SyntheticTerrainSettings;
  number("--width-m", &Settings::width_m, "east to west");
  number("--height-m", &Settings::height_m, "north to south");
  number("--cell-m", &Settings::cell_m, "edge of a cell");
  number("--crater-diameter-min-m", &Settings::crater_diameter_min_m, "smallest crater");
  number("--crater-diameter-max-m", &Settings::crater_diameter_max_m, "largest crater");
  number("--crater-density-scale", &Settings::crater_density_scale, "1: as on a lunar mare");
  number("--roughness-m", &Settings::roughness_m, "standard deviation between craters");
  number("--rock-coverage", &Settings::rock_coverage, "share of the area under rocks");
  number("--rock-diameter-min-m", &Settings::rock_diameter_min_m, "smallest rock");
  number("--rock-diameter-max-m", &Settings::rock_diameter_max_m, "largest rock");
  number("--soil-zone-size-m", &Settings::soil_zone_size_m, "typical width of a zone");
  parser->add_option("--soil-zones", options->terrain.soil_zones, "class codes 1 to N")
      ->type_name("N")
      ->check(whole_in_range({.min = 1, .max = kSoilZonesMax}))
      ->capture_default_str();
  parser->add_option("--soils", options->soils, "soils of the zones; default: lunar soils")
      ->type_name("FILE.yaml");
  add_stub_options(*parser, options->stub);
  add_force_flag(*parser, options->out);
  add_output_flags(*parser, options->json, options->quiet);
  return {parser, [options, parser] {
            for (const CLI::Option* option : parser->get_options()) {
              const std::string name = option->get_name();
              if (option->count() > 0 && name.ends_with("-m")) options->given.push_back(name);
            }
            return run_map_make(*options);
          }};
}

}  // namespace regoplan
