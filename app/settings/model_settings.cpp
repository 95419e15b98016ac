#include "app/settings/model_settings.h"

#include <fmt/format.h>

#include "app/settings/correction_settings.h"
#include "app/settings/settings_mapping.h"
#include "app/settings/soil_settings.h"
#include "terramech/parameters/gravity_range.h"

namespace regoplan {
namespace {

bool is_generic(const SettingsNode& node) {
  for (const SettingsEntry& entry : node.mapping()) {
    if (entry.key == "id") return entry.value.text() == kGenericId;
  }
  return false;
}

GenericCorrection read_generic(const SettingsNode& node) {
  return read_mapping(node, [](SettingsMapping& mapping) {
    mapping.required("id");
    if (const SettingsNode* form = mapping.optional("form")) form->choice({kGenericForm});
    return read_correction(mapping.required("parameters"));
  });
}

}  // namespace

Mechanism read_mechanism(SettingsMapping& mapping) {
  Mechanism mechanism{.id = mapping.required("id").text(), .form = {}, .parameters = {}};
  if (const SettingsNode* form = mapping.optional("form")) mechanism.form = form->text();
  if (const SettingsNode* parameters = mapping.optional("parameters")) {
    for (const SettingsEntry& parameter : parameters->mapping()) {
      mechanism.parameters[parameter.key] = parameter.value.number(kAnyNumber);
    }
  }
  form_of(mechanism);  // throws where an id, a form or a parameter is not known
  return mechanism;
}

std::string variant_name(WheelVariant variant) {
  return variant == WheelVariant::kYoshida2004 ? "yoshida2004" : "ishigami2007";
}

WheelVariant read_variant(const SettingsNode& node) {
  return node.choice({"ishigami2007", "yoshida2004"}) == 1 ? WheelVariant::kYoshida2004
                                                           : WheelVariant::kIshigami2007;
}

Wheel read_wheel(const SettingsNode& node) {
  return read_mapping(node, [](SettingsMapping& mapping) { return read_wheel(mapping); });
}

Wheel read_wheel(SettingsMapping& keys) {
  const Wheel wheel{.radius_m = keys.number("radius_m", kAbove0),
                    .width_m = keys.number("width_m", kAbove0)};
  validate(wheel);
  return wheel;
}

ModelSettings read_model(const SettingsNode& node) {
  return read_mapping(node, [](SettingsMapping& mapping) {
    ModelSettings settings;
    if (const SettingsNode* mechanisms = mapping.optional("mechanisms")) {
      for (const SettingsNode& mechanism : mechanisms->list()) {
        if (!is_generic(mechanism)) {
          settings.spec.mechanisms.push_back(read_mapping(mechanism, read_mechanism));
        } else if (settings.spec.generic) {
          throw mechanism.error("generic stands twice (allowed: once)");
        } else {
          settings.spec.generic = read_generic(mechanism);
        }
      }
    }
    settings.spec.variant = read_variant(mapping.required("model"));
    settings.spec.wheel = read_wheel(mapping.required("wheel"));
    settings.spec.gravity_mps2 = mapping.number("gravity_mps2", kGravity_mps2);
    const SettingsNode& soil = mapping.required("soil");
    settings.soil = read_mapping(
        soil, [&](SettingsMapping& keys) { return read_soil(keys, settings.spec.variant); });
    require_resistance(soil, settings.soil.mean, settings.spec.wheel.width_m);
    settings.spec.soil = settings.soil.mean;
    settings.warnings = doubtful_units(soil, settings.soil.mean);
    if (const SettingsNode* name = mapping.optional("soil_name")) settings.soil_name = name->text();
    return settings;
  });
}

ModelSettings read_model_file(const std::string& file) {
  return read_model(read_settings(file));
}

std::string model_text(const ModelSettings& settings) {
  const WheelModelSpec& spec = settings.spec;
  std::string text = fmt::format(
      "model: {}\nwheel: {{radius_m: {}, width_m: {}}}\ngravity_mps2: {}\n",
      variant_name(spec.variant), spec.wheel.radius_m, spec.wheel.width_m, spec.gravity_mps2);
  if (settings.soil_name) text += fmt::format("soil_name: {}\n", quoted_text(*settings.soil_name));
  text += "soil:\n" + soil_keys_text(settings.soil, "  ");
  if (spec.mechanisms.empty() && !spec.generic) return text + "mechanisms: []\n";
  text += "mechanisms:\n";
  for (const Mechanism& mechanism : spec.mechanisms) {
    text += fmt::format("  - id: {}\n", mechanism.id);
    if (!mechanism.form.empty()) text += fmt::format("    form: {}\n", mechanism.form);
    if (!mechanism.parameters.empty()) text += "    parameters:\n";
    for (const auto& [name, value] : mechanism.parameters) {
      text += fmt::format("      {}: {}\n", name, value);
    }
  }
  if (spec.generic) {
    text += fmt::format("  - id: {}\n    form: {}\n    parameters:\n", kGenericId, kGenericForm) +
            correction_text(*spec.generic, "      ");
  }
  return text;
}

}  // namespace regoplan
