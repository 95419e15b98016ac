#include <fmt/format.h>

#include <memory>
#include <optional>

#include "app/command/command.h"
#include "app/command/plan_options.h"
#include "app/io/interrupt.h"
#include "app/io/staged_files.h"
#include "app/map/map_folder.h"
#include "app/map/map_summary.h"
#include "app/map/stub_options.h"
#include "app/settings/map_notices.h"
#include "app/settings/soil_settings.h"
#include "maps/raster_files.h"
#include "terramech/basics/input_error.h"

namespace regoplan {
namespace {

struct MapImportOptions {
  std::string elevation;
  HeightReading heights;
  std::optional<std::string> classes;
  std::string soils;
  std::optional<std::string> rocks;
  ScenarioStub stub{.vehicle = "lrv"};
  ResultFolder out;
  bool json = false;
  bool quiet = false;
};

ExitStatus run_map_import(const MapImportOptions& options) {
  require_writable_folder(options.out);
  if (options.heights.scale == 0) {
    throw InputError("--scale: 0 is not valid (allowed: any number but 0)");
  }
  const SettingsNode soils_file = read_settings(options.soils);
  SoilCatalogue soils = read_soil_catalogue(soils_file, WheelVariant::kIshigami2007);
  if (!options.classes && soils.soils.size() != 1) {
    const SettingsNode* named = soils_file.find("soils");
    throw(named ? *named : soils_file)
        .error(fmt::format("{} soils, and nothing says where each of them lies (allowed without "
                           "--soil-class: one)",
                           soils.soils.size()));
  }
  for (const std::string& doubt : doubtful_units(soils_file, soils)) notify(doubt, options.quiet);
  ElevationRaster elevation = read_elevation(options.elevation, options.heights);
  std::optional<ClassRaster> classes;
  if (options.classes) {
    classes = read_classes(*options.classes);
    const std::string notice = adopt_crs(*classes, elevation.frame, *options.classes);
    if (!notice.empty()) notify(notice, options.quiet);
  }
  std::vector<Rock> rocks;
  if (options.rocks) rocks = read_rocks(*options.rocks, elevation.frame);
  const TerrainMap map(std::move(elevation), std::move(classes), std::move(soils),
                       std::move(rocks));
  if (options.classes) {
    for (const std::string& notice : {unlisted_classes_notice(map, *options.classes),
                                      uncovered_notice(map, *options.classes)}) {
      if (!notice.empty()) notify(notice, options.quiet);
    }
  }
  if (options.rocks) {
    const std::string notice = rocks_off_map_notice(map, *options.rocks);
    if (!notice.empty()) notify(notice, options.quiet);
  }
  if (!write_map_folder(map, options.stub, options.out, stop_on_interrupt())) return kInterrupted;
  for (const std::string& notice : map_notices(map, stub_vehicle(options.stub))) {
    notify(notice, options.quiet);
  }
  print_map_written(map, options.out.path, options.json, options.quiet);
  return kYes;
}

}  // namespace

Command add_map_import_command(CLI::App& map) {
  const auto options = std::make_shared<MapImportOptions>();
  CLI::App* parser = map.add_subcommand(
      "import",
      "Check an elevation raster, a class raster and their soils, and make a map of them.\n"
      "Writes dem.tif, classes.tif, soils.yaml, rocks.csv and scenario.yaml, and copies "
      "a vehicle file.");
  parser
      ->add_option("--elevation", options->elevation,
                   "metres: any raster that GDAL reads, or a table of points x, y, height (.csv, "
                   ".xyz)")
      ->type_name("FILE")
      ->required();
  const auto number = [&](const char* name, std::optional<double>& value, const char* help) {
    parser->add_option(name, value, help)->type_name("NUMBER")->check(in_range(kAnyNumber));
  };
  number("--scale", options->heights.scale,
         "metres a unit of the elevation; else as its file says");
  number("--offset", options->heights.offset_m, "height in metres of its 0; else as its file says");
  number("--nodata", options->heights.nodata, "what cells without height hold, if undeclared");
  parser->add_option("--soil-class", options->classes, "raster of integers, same CRS, own grid")
      ->type_name("FILE");
  parser->add_option("--soils", options->soils, "classes, soils, unmapped")
      ->type_name("FILE.yaml")
      ->required();
  parser->add_option("--rocks", options->rocks, "x_m, y_m, radius_m, height_m")
      ->type_name("FILE.csv");
  parser->add_option("--out", options->out.path, "folder for the map")
      ->type_name("DIR")
      ->required();
  add_stub_options(*parser, options->stub);
  parser->get_option("--gravity-mps2")->required()->default_str("");
  add_force_flag(*parser, options->out);
  add_network_flag(*parser);
  add_output_flags(*parser, options->json, options->quiet);
  return {parser, [options] { return run_map_import(*options); }};
}

}  // namespace regoplan
