#include "app/settings/soil_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <iterator>
#include <limits>
#include <string_view>

#include "terramech/tables/number_text.h"

namespace regoplan {
namespace {

constexpr const char* kForbidden = "forbidden";

/// A number in the file's unit and its standard deviation.
struct UncertainNumber {
  double mean = 0;
  double standard_deviation = 0;
};

UncertainNumber read_uncertain_number(const SettingsNode& node, const ValueRange& allowed) {
  if (node.kind() != SettingsNode::Kind::kMapping) return {.mean = node.number(allowed)};
  return read_mapping(node, [&](SettingsMapping& mapping) {
    return UncertainNumber{.mean = mapping.number("mean", allowed),
                           .standard_deviation = mapping.number("std", kAtLeast0)};
  });
}

MapSoil read_map_soil(const SettingsEntry& entry, WheelVariant variant) {
  if (entry.key == kForbidden) throw entry.value.error("a soil cannot have this name");
  return read_mapping(entry.value, [&](SettingsMapping& mapping) {
    return MapSoil{.name = entry.key,
                   .source = mapping.required("source").text(),
                   .soil = read_soil(mapping, variant)};
  });
}

std::int32_t class_code(const SettingsEntry& entry) {
  std::int32_t code = 0;
  const char* end = entry.key.data() + entry.key.size();
  const auto [parsed, failed] = std::from_chars(entry.key.data(), end, code);
  if (failed != std::errc() || parsed != end || code == ClassRaster::kNoData) {
    throw entry.value.error(
        fmt::format("{} is not valid as a class code (allowed: an integer)", entry.key));
  }
  return code;
}

int soil_named(const std::vector<MapSoil>& soils, const SettingsNode& name, bool or_forbidden) {
  std::vector<std::string> names;
  std::transform(soils.begin(), soils.end(), std::back_inserter(names),
                 [](const MapSoil& soil) { return soil.name; });
  if (or_forbidden) names.emplace_back(kForbidden);
  return static_cast<int>(name.choice(names));
}

std::string soil_text(const MapSoil& soil) {
  return fmt::format("  {}:\n    source: {}\n", quoted_text(soil.name), quoted_text(soil.source)) +
         soil_keys_text(soil.soil, "    ");
}

}  // namespace

UncertainSoil read_soil(SettingsMapping& mapping, WheelVariant variant) {
  UncertainSoil soil;
  for (const SoilParameter& parameter : soil_parameters()) {
    const bool required = !parameter.optional || (parameter.member == &Soil::c0_m &&
                                                  variant == WheelVariant::kYoshida2004);
    const SettingsNode* node =
        required ? &mapping.required(parameter.name) : mapping.optional(parameter.name);
    const ValueRange allowed{
        .min = parameter.min, .max = parameter.max, .min_excluded = parameter.min_excluded};
    const UncertainNumber number = node ? read_uncertain_number(*node, allowed) : UncertainNumber{};
    soil.mean.*parameter.member = number.mean * parameter.file_unit;
    soil.standard_deviation.*parameter.member = number.standard_deviation * parameter.file_unit;
  }
  validate(soil.mean);
  return soil;
}

SoilCatalogue read_soil_catalogue(const SettingsNode& node, WheelVariant variant) {
  return read_mapping(node, [&](SettingsMapping& mapping) {
    SoilCatalogue catalogue;
    const SettingsNode& soils = mapping.required("soils");
    for (const SettingsEntry& entry : soils.mapping()) {
      catalogue.soils.push_back(read_map_soil(entry, variant));
    }
    if (catalogue.soils.empty()) throw soils.error("no soil");
    if (const SettingsNode* classes = mapping.optional("classes")) {
      for (const SettingsEntry& entry : classes->mapping()) {
        const std::int32_t code = class_code(entry);
        const auto same_code = [code](const auto& other) { return other.first == code; };
        if (std::ranges::any_of(catalogue.classes, same_code)) {
          throw entry.value.error("class code given twice");
        }
        catalogue.classes.emplace_back(code, soil_named(catalogue.soils, entry.value, false));
      }
    }
    if (const SettingsNode* unmapped = mapping.optional("unmapped")) {
      const int index = soil_named(catalogue.soils, *unmapped, true);
      if (index < static_cast<int>(catalogue.soils.size())) catalogue.unmapped = index;
    }
    return catalogue;
  });
}

void require_resistance(const SettingsNode& soil, const Soil& mean, double wheel_width_m) {
  if (resists_sinkage(mean, wheel_width_m)) return;
  throw placed_error(
      soil, ValueError("kc", mean.kc,
                       fmt::format("kc/width_m + kphi above 0, with kphi {} and wheels of {} m",
                                   mean.kphi, wheel_width_m)));
}

void require_resistance(const SettingsNode& node, const SoilCatalogue& catalogue,
                        double wheel_width_m) {
  const SettingsNode* soils = node.find("soils");
  for (std::size_t i = 0; soils && i < catalogue.soils.size(); ++i) {
    require_resistance(soils->mapping().at(i).value, catalogue.soils[i].soil.mean, wheel_width_m);
  }
}

std::vector<std::string> doubtful_units(const SettingsNode& soil, const Soil& mean) {
  struct Doubt {
    std::string_view key;
    double usual_min, usual_max;      // in the file's unit
    const char *of_small, *of_large;  // what is suspected
  };
  constexpr double kShearModulusMax_m = 0.3;
  constexpr double kNoMax = std::numeric_limits<double>::infinity();
  constexpr std::array<Doubt, 6> kDoubts{{
      {"friction_angle_deg", 2, kNoMax, "radians", ""},
      {"cohesion_pa", 10, 2e5, "kPa", "Pa taken for kPa"},
      {"density_kgpm3", 100, 5e3, "g/cm3", "N/m3"},
      {"kphi", 1e4, 1e8, "kN/m^(n+2)", "N/m^(n+2) taken for kN/m^(n+2)"},
      {"kx0_m", 0, kShearModulusMax_m, "", "cm or mm"},
      {"ky0_m", 0, kShearModulusMax_m, "", "cm or mm"},
  }};
  std::vector<std::string> sentences;
  for (const SoilParameter& parameter : soil_parameters()) {
    const auto* const doubt = std::ranges::find(kDoubts, parameter.name, &Doubt::key);
    if (doubt == kDoubts.end()) continue;
    const double value = mean.*parameter.member / parameter.file_unit;
    const bool small = value != 0 && value < doubt->usual_min;  // a soil may have no cohesion
    if (!small && value <= doubt->usual_max) continue;
    const std::string text = number_in_unit(mean.*parameter.member, parameter.file_unit);
    const SettingsNode* place = soil.find(doubt->key);
    const std::string usual = small ? fmt::format("from {} on", doubt->usual_min)
                                    : fmt::format("up to {}", doubt->usual_max);
    sentences.emplace_back((place ? *place : soil)
                               .error(fmt::format("{} is {} for a soil (usual: {}); suspected: {}",
                                                  text, small ? "small" : "large", usual,
                                                  small ? doubt->of_small : doubt->of_large))
                               .what());
  }
  return sentences;
}

std::vector<std::string> doubtful_units(const SettingsNode& node, const SoilCatalogue& catalogue) {
  std::vector<std::string> sentences;
  const SettingsNode* soils = node.find("soils");
  for (std::size_t i = 0; soils && i < catalogue.soils.size(); ++i) {
    const SettingsNode& soil = soils->mapping().at(i).value;
    std::ranges::move(doubtful_units(soil, catalogue.soils[i].soil.mean),
                      std::back_inserter(sentences));
  }
  return sentences;
}

std::string soil_keys_text(const UncertainSoil& soil, const std::string& indent) {
  std::string text;
  for (const SoilParameter& parameter : soil_parameters()) {
    const std::string mean = number_in_unit(soil.mean.*parameter.member, parameter.file_unit);
    const double deviation = soil.standard_deviation.*parameter.member;
    text += deviation == 0 ? fmt::format("{}{}: {}\n", indent, parameter.name, mean)
                           : fmt::format("{}{}: {{mean: {}, std: {}}}\n", indent, parameter.name,
                                         mean, number_in_unit(deviation, parameter.file_unit));
  }
  return text;
}

std::string quoted_text(const std::string& text) {
  std::string quoted = "'";
  for (const char letter : text) {
    if (letter == '\'') quoted += '\'';
    quoted += letter == '\n' ? ' ' : letter;
  }
  return quoted + "'";
}

std::string soil_catalogue_text(const SoilCatalogue& catalogue) {
  const auto name = [&catalogue](int index) {
    return quoted_text(catalogue.soils.at(static_cast<std::size_t>(index)).name);
  };
  std::string text;
  if (!catalogue.classes.empty()) {
    text += "classes:\n";
    for (const auto& [code, soil] : catalogue.classes) {
      text += fmt::format("  {}: {}\n", code, name(soil));
    }
  }
  text += fmt::format("unmapped: {}\nsoils:\n",
                      catalogue.unmapped ? name(*catalogue.unmapped) : kForbidden);
  for (const MapSoil& soil : catalogue.soils) text += soil_text(soil);
  return text;
}

}  // namespace regoplan
