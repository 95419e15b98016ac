#include "app/map/stub_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "app/command/command.h"
#include "terramech/parameters/gravity_range.h"
#include "terramech/parameters/vehicle.h"

namespace regoplan {
namespace {

/// An option takes a preset, or a file that exists.
CLI::Validator names_a_vehicle() {
  return {[](std::string& text) {
            const std::vector<std::string> presets = preset_vehicle_names();
            const bool known = std::ranges::find(presets, text) != presets.end() ||
                               std::filesystem::is_regular_file(text);
            return known
                       ? std::string()
                       : fmt::format("{} is not valid (allowed: {}, or a vehicle file that exists)",
                                     text, fmt::join(presets, " | "));
          },
          ""};
}

}  // namespace

void add_stub_options(CLI::App& parser, ScenarioStub& stub) {
  parser
      .add_option("--vehicle", stub.vehicle,
                  "vehicle of scenario.yaml: a preset, or a file that is copied beside it")
      ->type_name("NAME")
      ->check(names_a_vehicle())
      ->capture_default_str();
  parser.add_option("--gravity-mps2", stub.gravity_mps2, "gravity of scenario.yaml")
      ->type_name("NUMBER")
      ->check(in_range(kGravity_mps2))
      ->capture_default_str();
}

}  // namespace regoplan
