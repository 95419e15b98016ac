#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <memory>
#include <sstream>

#include "app/command/command.h"
#include "app/io/share_files.h"
#include "app/settings/preset_soils.h"
#include "app/settings/soil_settings.h"
#include "app/settings/vehicle_settings.h"
#include "app/starter_files/commented_yaml.h"

namespace regoplan {
namespace {

std::string vehicle_file(const std::string& name) {
  return fmt::format(
      "# A vehicle's file, after the preset {}: `vehicle: FILE.yaml` in a scenario. Frame: x "
      "forward, y left,\n# origin on the ground below the centre of gravity.\n{}",
      name, commented_yaml(vehicle_text(preset_vehicle(name))));
}

std::string soil_file(const std::string& name) {
  const std::vector<MapSoil> known = preset_soils(share_file("scenarios/demo/soils.yaml"));
  const auto soil = std::ranges::find(known, name, &MapSoil::name);
  if (soil == known.end()) {
    std::vector<std::string> names;
    for (const MapSoil& each : known) names.push_back(each.name);
    throw InputError(
        fmt::format("soil: {} is not known (allowed: {})", name, fmt::join(names, " | ")));
  }
  const SoilCatalogue one{.soils = {*soil}, .classes = {{1, 0}}, .unmapped = 0};
  return "# A soils file: `map: {soils: FILE.yaml}` in a scenario. A number, or {mean, std} where "
         "it "
         "is uncertain.\n" +
         commented_yaml(soil_catalogue_text(one));
}

std::string scenario_file() {
  const std::string file = share_file("examples/scenario.yaml");
  std::ifstream stream(file, std::ios::binary);
  std::stringstream text;
  if (!stream || !(text << stream.rdbuf())) throw InputError(file + ": cannot be read");
  return text.str();
}

/// A command that prints one file: it has no result beside that, and nothing to be quiet about.
Command print_command(CLI::App& parser, const std::function<std::string()>& file) {
  return {&parser, [file] {
            fmt::print("{}", file());
            return kYes;
          }};
}

}  // namespace

Command add_vehicle_command(CLI::App& program) {
  const auto name = std::make_shared<std::string>();
  CLI::App* parser =
      program.add_subcommand("vehicle", "Print a vehicle's file to copy, with comments.");
  parser->add_option("NAME", *name, fmt::format("{}", fmt::join(preset_vehicle_names(), ", ")))
      ->required()
      ->check(one_of(preset_vehicle_names()));
  return print_command(*parser, [name] { return vehicle_file(*name); });
}

Command add_soil_command(CLI::App& program) {
  const auto name = std::make_shared<std::string>();
  CLI::App* parser =
      program.add_subcommand("soil", "Print a soils file to copy, with comments and sources.");
  parser
      ->add_option(
          "NAME", *name,
          "a soil that comes with regoplan, such as firm_regolith; an unknown name lists them all")
      ->required();
  return print_command(*parser, [name] { return soil_file(*name); });
}

Command add_scenario_command(CLI::App& program) {
  CLI::App* parser = program.add_subcommand(
      "scenario", "Print a scenario to copy, with comments; it states its own ground and soil.");
  return print_command(*parser, scenario_file);
}

}  // namespace regoplan
