#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "app/command/command.h"
#include "app/command/plan_options.h"
#include "app/map/map_summary.h"
#include "app/settings/scenario_settings.h"
#include "maps/raster_files.h"

namespace regoplan {
namespace {

struct MapInfoOptions {
  std::vector<std::string> files;
  bool json = false;
  bool quiet = false;
};

bool is_scenario(const std::string& file) {
  return file.ends_with(".yaml") || file.ends_with(".yml");
}

TerrainMap read_any_map(const std::string& file, bool quiet) {
  if (!is_scenario(file)) {
    // A bare raster has no soils; a map must have one.
    return {read_elevation(file), {}, {.soils = {{}}, .classes = {}, .unmapped = {}}, {}};
  }
  ScenarioMap read = read_scenario_map(file);
  for (const std::string& notice : read.notices) notify(notice, quiet);
  return std::move(read.map);
}

ExitStatus run_map_info(const MapInfoOptions& options) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  std::string text;
  for (const std::string& file : options.files) {
    const TerrainSummary summary = summarize(read_any_map(file, options.quiet));
    json[file] = summary_json(summary, is_scenario(file));
    text += fmt::format("{}\n{}", file, summary_text(summary, is_scenario(file)));
  }
  fmt::print("{}", options.json ? json.dump(2) + "\n" : text);
  return kYes;
}

}  // namespace

Command add_map_info_command(CLI::App& map) {
  const auto options = std::make_shared<MapInfoOptions>();
  CLI::App* parser =
      map.add_subcommand("info", "Describe the maps of scenarios, or bare elevation rasters.");
  parser->add_option("FILE", options->files, "SCENARIO.yaml, or a raster")->required();
  add_network_flag(*parser);
  add_output_flags(*parser, options->json, options->quiet);
  return {parser, [options] { return run_map_info(*options); }};
}

}  // namespace regoplan
