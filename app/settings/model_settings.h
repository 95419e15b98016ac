#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/settings/settings_mapping.h"
#include "app/settings/settings_node.h"
#include "terramech/wheel/wheel_model.h"

namespace regoplan {

/// A wheel model as a model file describes it.
struct ModelSettings {
  WheelModelSpec spec;                   ///< `{mean, std}` counts by its mean
  UncertainSoil soil;                    ///< the soil with what is known of its spread
  std::optional<std::string> soil_name;  ///< the soil of a map that these numbers replace
  std::vector<std::string> warnings{};   ///< soil numbers whose unit is doubtful, a sentence each
};

/// Reads `{model, wheel: {radius_m, width_m}, gravity_mps2, soil: {<soil keys>}, soil_name,
/// mechanisms: [{id, form, parameters}]}`; the id `generic` is the unnamed correction.
ModelSettings read_model(const SettingsNode& node);
ModelSettings read_model_file(const std::string& file);

/// The model as a model file that reads back to the same numbers, bit for bit, where an angle is
/// one that degrees can express; else within its last place. Its soil is `settings.soil`.
std::string model_text(const ModelSettings& settings);

/// Reads `{id, form, parameters}`.
Mechanism read_mechanism(SettingsMapping& mapping);

/// Reads `ishigami2007` or `yoshida2004`.
WheelVariant read_variant(const SettingsNode& node);

/// The word under which a variant stands in files: `ishigami2007`, `yoshida2004`.
std::string variant_name(WheelVariant variant);

/// Reads a wheel `{radius_m, width_m}`.
Wheel read_wheel(const SettingsNode& node);
/// The same of a mapping that has other keys beside.
Wheel read_wheel(SettingsMapping& keys);

}  // namespace regoplan
