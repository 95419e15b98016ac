#include "app/diagnose/diagnosis_setup.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/settings/model_settings.h"
#include "app/settings/settings_mapping.h"
#include "app/settings/soil_settings.h"
#include "terramech/mechanisms/mechanism.h"
#include "terramech/parameters/gravity_range.h"

namespace regoplan {
namespace {

std::map<Channel, double> read_noise(const SettingsNode& node) {
  return read_mapping(node, [](SettingsMapping& mapping) {
    std::map<Channel, double> noise;
    for (const Channel channel : kChannels) {
      if (const SettingsNode* deviation = mapping.optional(name(channel))) {
        noise[channel] = deviation->number(kAbove0);
      }
    }
    return noise;
  });
}

/// A wheel that may have lugs.
void read_wheel(const SettingsNode& node, DiagnosisSetup& setup) {
  setup.wheel = read_mapping(node, [&](SettingsMapping& mapping) {
    if (const SettingsNode* height = mapping.optional("lug_height_m")) {
      setup.lug_height_m = height->number(of_lugs("lug_height_m"));
    }
    if (const SettingsNode* count = mapping.optional("lug_count")) {
      const auto most = static_cast<std::int64_t>(of_lugs("lugs").max);
      setup.lug_count = static_cast<int>(count->integer(0, most));
    }
    return read_wheel(mapping);
  });
}

}  // namespace

ValueRange of_lugs(std::string_view parameter) {
  const MechanismForm& lugs = form_of({.id = "grousers", .form = "passive_pressure"});
  const auto range = std::ranges::find(lugs.parameters, parameter, &MechanismParameter::name);
  return {.min = range->least, .max = range->most};
}

SetupSettings read_setup(const SettingsNode& node) {
  return read_mapping(node, [](SettingsMapping& mapping) {
    SetupSettings settings;
    DiagnosisSetup& setup = settings.setup;
    setup.variant = read_variant(mapping.required("model"));
    const SettingsNode& wheel = mapping.required("wheel");
    read_wheel(wheel, setup);
    constexpr double kLargest_m = 5;  // the usual mistake is millimetres
    for (const auto& [key, value] :
         {std::pair{"radius_m", setup.wheel.radius_m}, std::pair{"width_m", setup.wheel.width_m}}) {
      if (value > kLargest_m) {
        throw wheel.find(key)->error(fmt::format(
            "{} is not valid (allowed: above 0 to {}); suspected: mm", value, kLargest_m));
      }
    }
    setup.gravity_mps2 = mapping.number("gravity_mps2", kGravity_mps2);
    const SettingsNode& soil = mapping.required("soil");
    setup.soil =
        read_mapping(soil, [&](SettingsMapping& keys) { return read_soil(keys, setup.variant); });
    settings.warnings = doubtful_units(soil, setup.soil.mean);
    if (const SettingsNode* name = mapping.optional("soil_name")) settings.soil_name = name->text();
    if (const SettingsNode* noise = mapping.optional("noise")) {
      setup.noise_standard_deviation = read_noise(*noise);
    }
    if (const SettingsNode* mechanisms = mapping.optional("mechanisms")) {
      if (!mechanisms->list().empty()) {
        throw mechanisms->error("a diagnosis starts from the base model (allowed: none)");
      }
    }
    return settings;
  });
}

SetupSettings read_setup_file(const std::string& file) {
  return read_setup(read_settings(file));
}

}  // namespace regoplan
