#include "app/settings/terrain_settings.h"

#include <utility>

#include "app/settings/settings_mapping.h"
#include "terramech/basics/angles.h"

namespace regoplan {
namespace {

constexpr ValueRange kSlope_deg{.min = -45, .max = 45};

DrawnCrater read_crater(const SettingsNode& node) {
  return read_mapping(node, [](SettingsMapping& mapping) {
    return DrawnCrater{.x_m = mapping.number("x_m", kAnyNumber),
                       .y_m = mapping.number("y_m", kAnyNumber),
                       .diameter_m = mapping.number("diameter_m", kAbove0),
                       .depth_m = mapping.number("depth_m", kAtLeast0),
                       .rim_height_m = mapping.number_or("rim_height_m", kAtLeast0, 0)};
  });
}

DrawnDunes read_dunes(const SettingsNode& node) {
  return read_mapping(node, [](SettingsMapping& mapping) {
    return DrawnDunes{
        .wavelength_m = mapping.number("wavelength_m", kAbove0),
        .height_m = mapping.number("height_m", kAtLeast0),
        .wind_rad = mapping.number_or("wind_deg", {.min = -360, .max = 360}, 0) * kDegree};
  });
}

DrawnZone read_zone(const SettingsNode& node) {
  return read_mapping(node, [](SettingsMapping& mapping) {
    return DrawnZone{.code = static_cast<int>(mapping.required("code").integer(0, 65535)),
                     .west_m = mapping.number("west_m", kAnyNumber),
                     .east_m = mapping.number("east_m", kAnyNumber),
                     .south_m = mapping.number("south_m", kAnyNumber),
                     .north_m = mapping.number("north_m", kAnyNumber)};
  });
}

Rock read_rock(const SettingsNode& node) {
  return read_mapping(node, [](SettingsMapping& mapping) {
    return Rock{.x_m = mapping.number("x_m", kAnyNumber),
                .y_m = mapping.number("y_m", kAnyNumber),
                .radius_m = mapping.number("radius_m", kAbove0),
                .height_m = mapping.number("height_m", kAbove0)};
  });
}

std::pair<double, double> read_place(const SettingsNode& node) {
  return read_mapping(node, [](SettingsMapping& mapping) {
    return std::pair(mapping.number("x_m", kAnyNumber), mapping.number("y_m", kAnyNumber));
  });
}

DrawnRockRow read_rock_row(const SettingsNode& node) {
  return read_mapping(node, [](SettingsMapping& mapping) {
    const auto [from_x_m, from_y_m] = read_place(mapping.required("from"));
    const auto [to_x_m, to_y_m] = read_place(mapping.required("to"));
    return DrawnRockRow{.from_x_m = from_x_m,
                        .from_y_m = from_y_m,
                        .to_x_m = to_x_m,
                        .to_y_m = to_y_m,
                        .spacing_m = mapping.number("spacing_m", kAbove0),
                        .radius_m = mapping.number("radius_m", kAbove0),
                        .height_m = mapping.number("height_m", kAbove0)};
  });
}

template <class Item>
std::vector<Item> read_list(SettingsMapping& mapping, std::string_view key,
                            Item (*read)(const SettingsNode&)) {
  std::vector<Item> items;
  if (const SettingsNode* list = mapping.optional(key)) {
    for (const SettingsNode& item : list->list()) items.push_back(read(item));
  }
  return items;
}

}  // namespace

DrawnTerrain read_terrain(const SettingsNode& node) {
  return read_mapping(node, [](SettingsMapping& mapping) {
    DrawnTerrain drawn;
    drawn.width_m = mapping.number("width_m", kAbove0);
    drawn.height_m = mapping.number("height_m", kAbove0);
    drawn.cell_m = mapping.number_or("cell_m", kAbove0, drawn.cell_m);
    drawn.slope_east_rad = mapping.number_or("slope_east_deg", kSlope_deg, 0) * kDegree;
    drawn.slope_north_rad = mapping.number_or("slope_north_deg", kSlope_deg, 0) * kDegree;
    drawn.roughness_m = mapping.number_or("roughness_m", {.min = 0, .max = 10}, 0);
    if (const SettingsNode* seed = mapping.optional("seed")) {
      drawn.seed = static_cast<std::uint64_t>(seed->integer(0, 4000000000));
    }
    if (const SettingsNode* soil = mapping.optional("soil")) {
      drawn.soil = static_cast<int>(soil->integer(0, 65535));
    }
    drawn.craters = read_list(mapping, "craters", read_crater);
    if (const SettingsNode* dunes = mapping.optional("dunes")) drawn.dunes = read_dunes(*dunes);
    drawn.zones = read_list(mapping, "zones", read_zone);
    drawn.rocks = read_list(mapping, "rocks", read_rock);
    drawn.rock_rows = read_list(mapping, "rock_rows", read_rock_row);
    return drawn;
  });
}

}  // namespace regoplan
