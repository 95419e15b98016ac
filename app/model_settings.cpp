#include "app/model_settings.h"

#include "app/settings_mapping.h"
#include "app/soil_settings.h"

namespace regoplan {
namespace {

void require_no_mechanisms(const SettingsNode& node) {
  for (const SettingsNode& mechanism : node.list()) {
    const SettingsNode* id = mechanism.find("id");
    throw(id ? *id : mechanism).not_allowed("an empty list; no mechanism is supported yet");
  }
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
      require_no_mechanisms(*mechanisms);
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
