#pragma once

#include <filesystem>
#include <string>

#include "app/settings/settings_mapping.h"
#include "maps/terrain_map.h"
#include "terramech/wheel/wheel_model.h"

namespace regoplan {

/// Reads the soil keys (`soil_parameters()`), each a number or `{mean, std}`, that stand in
/// `mapping`. yoshida2004 requires `c0_m`.
UncertainSoil read_soil(SettingsMapping& mapping, WheelVariant variant);

/// Reads `{classes: {CODE: NAME}, soils: {NAME: {source, <soil keys>}}, unmapped: NAME |
/// forbidden}`; without `unmapped`, unmapped cells are forbidden.
SoilCatalogue read_soil_catalogue(const SettingsNode& node, WheelVariant variant);

/// The catalogue as a soils file that reads back to the same numbers, bit for bit.
std::string soil_catalogue_text(const SoilCatalogue& catalogue);

/// A soil's keys, one a line behind `indent`: numbers, or `{mean, std}` where the deviation is not
/// 0.
std::string soil_keys_text(const UncertainSoil& soil, const std::string& indent);

/// A text as a YAML scalar, quoted.
std::string quoted_text(const std::string& text);

}  // namespace regoplan
