#include "app/model_settings.h"

#include "app/settings_mapping.h"
#include "app/soil_settings.h"

namespace regoplan {
namespace {

Mechanism read_mechanism(const SettingsNode& node) {
  return read_mapping(node, [](SettingsMapping& mapping) {
    Mechanism mechanism{.id = mapping.required("id").text(), .form = {}, .parameters = {}};
    if (const SettingsNode* form = mapping.optional("form")) mechanism.form = form->text();
    if (const SettingsNode* parameters = mapping.optional("parameters")) {
      for (const SettingsEntry& parameter : parameters->mapping()) {
        mechanism.parameters[parameter.key] = parameter.value.number(kAnyNumber);
      }
    }
    form_of(mechanism);  // throws where an id, a form or a parameter is not known
    return mechanism;
  });
}

}  // namespace

std::string variant_name(WheelVariant variant) {
  return variant == WheelVariant::kYoshida2004 ? "yoshida2004" : "ishigami2007";
}

Wheel read_wheel(const SettingsNode& node) {
  return read_mapping(node, [](SettingsMapping& mapping) {
    const Wheel wheel{.radius_m = mapping.number("radius_m", kAbove0),
                      .width_m = mapping.number("width_m", kAbove0)};
    validate(wheel);
    return wheel;
  });
}

ModelSettings read_model(const SettingsNode& node) {
  return read_mapping(node, [](SettingsMapping& mapping) {
    ModelSettings settings;
    if (const SettingsNode* mechanisms = mapping.optional("mechanisms")) {
      for (const SettingsNode& mechanism : mechanisms->list()) {
        settings.spec.mechanisms.push_back(read_mechanism(mechanism));
      }
    }
    settings.spec.variant = mapping.required("model").choice({"ishigami2007", "yoshida2004"}) == 1
                                ? WheelVariant::kYoshida2004
                                : WheelVariant::kIshigami2007;
    settings.spec.wheel = read_wheel(mapping.required("wheel"));
    settings.spec.gravity_mps2 = mapping.number("gravity_mps2", kAbove0);
    settings.soil = read_mapping(mapping.required("soil"), [&](SettingsMapping& soil) {
      return read_soil(soil, settings.spec.variant);
    });
    settings.spec.soil = settings.soil.mean;
    if (const SettingsNode* name = mapping.optional("soil_name")) settings.soil_name = name->text();
    return settings;
  });
}

ModelSettings read_model_file(const std::string& file) {
  return read_model(read_settings(file));
}

}  // namespace regoplan
