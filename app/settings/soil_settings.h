#pragma once

#include <filesystem>
#include <string>
#include <vector>

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

/// \throws SettingsError where a soil, in the mean, does not carry a wheel of this width at all
/// \param soil where the keys stand
void require_resistance(const SettingsNode& soil, const Soil& mean, double wheel_width_m);
/// Of every soil of a catalogue. \param node what `catalogue` was read from
void require_resistance(const SettingsNode& node, const SoilCatalogue& catalogue,
                        double wheel_width_m);

/// Means that hardly any soil has, but that the usual slip of a unit gives (an angle in radians,
/// kPa for Pa, ...): a sentence each, with file, line, key, value and the unit that is suspected.
/// \param soil where the keys stand \param mean what was read there
std::vector<std::string> doubtful_units(const SettingsNode& soil, const Soil& mean);

/// Of every soil of a catalogue. \param node what `catalogue` was read from
std::vector<std::string> doubtful_units(const SettingsNode& node, const SoilCatalogue& catalogue);

/// The catalogue as a soils file that reads back to the same numbers, bit for bit.
std::string soil_catalogue_text(const SoilCatalogue& catalogue);

/// A soil's keys, one a line behind `indent`: numbers, or `{mean, std}` where the deviation is not
/// 0.
std::string soil_keys_text(const UncertainSoil& soil, const std::string& indent);

/// A text as a YAML scalar, quoted.
std::string quoted_text(const std::string& text);

}  // namespace regoplan
