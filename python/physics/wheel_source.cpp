#include "python/physics/wheel_source.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "app/settings/model_settings.h"
#include "app/settings/preset_soils.h"
#include "app/settings/soil_settings.h"
#include "python/shared/settings_text.h"
#include "terramech/basics/input_error.h"
#include "terramech/wheel/paper_figures.h"

namespace regoplan::python {

namespace {

constexpr auto kMethods = std::to_array<std::string_view>({"direct", "fast", "table"});

}  // namespace

std::vector<std::string> method_names() {
  return {kMethods.begin(), kMethods.end()};
}

std::vector<std::string> variant_names() {
  return {variant_name(WheelVariant::kIshigami2007), variant_name(WheelVariant::kYoshida2004)};
}

WheelSource wheel_source(const std::string& settings, const std::string& how,
                         double nominal_load_n) {
  if (std::ranges::find(kMethods, how) == kMethods.end()) {
    throw InputError(
        fmt::format("method: {} is not valid (allowed: {})", how, fmt::join(kMethods, " | ")));
  }
  const WheelModelSpec spec = read_model(settings_of(settings, "wheel")).spec;
  if (how == "table") {
    auto table = std::make_shared<const ForceTable>(
        ForceTable::cached({.model = spec, .nominal_load_n = nominal_load_n, .accuracy = {}}));
    return {.direct = std::make_shared<const WheelModel>(table->direct()), .table = table};
  }
  const WheelAccuracy accuracy = how == "fast" ? WheelAccuracy::kFast : WheelAccuracy::kExact;
  return {.direct = std::make_shared<const WheelModel>(spec, accuracy), .table = nullptr};
}

std::string checked_soil(const std::string& settings) {
  const UncertainSoil soil = read_mapping(
      settings_of(settings, "soil"),
      [](SettingsMapping& mapping) { return read_soil(mapping, WheelVariant::kIshigami2007); });
  return json_of(settings_of(soil_keys_text(soil, ""), "soil"));
}

std::string model_file_settings(const std::string& file) {
  const SettingsNode settings = read_settings(file);
  read_model(settings);  // throws where it is not valid
  return json_of(settings);
}

std::string paper_wheel_settings() {
  const WheelModelSpec spec = paper_model();
  const ModelSettings settings{.spec = spec, .soil = {.mean = spec.soil}, .soil_name = {}};
  return json_of(settings_of(model_text(settings), "model"));
}

namespace {

std::string json_of_soils(const std::vector<MapSoil>& soils) {
  std::string text;
  for (const MapSoil& soil : soils) {
    text += quoted_text(soil.name) + ":\n  source: " + quoted_text(soil.source) + "\n" +
            soil_keys_text(soil.soil, "  ");
  }
  return json_of(settings_of(text, "soils"));
}

}  // namespace

std::string soils_file_settings(const std::string& file) {
  return json_of_soils(read_soil_catalogue(read_settings(file), WheelVariant::kIshigami2007).soils);
}

std::string preset_soil_settings(const std::string& demo_soils) {
  return json_of_soils(preset_soils(demo_soils));
}

}  // namespace regoplan::python
