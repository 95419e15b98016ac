#include "app/diagnose_drive/drive_columns.h"

#include <algorithm>
#include <numbers>

#include "app/settings/settings_mapping.h"
#include "terramech/basics/angles.h"

namespace regoplan {
namespace {

constexpr double kRpm = std::numbers::pi / 30;

struct ColumnUnit {
  std::string_view suffix;
  std::string_view held;
  double per_unit;
};

/// A family of columns: what stands between its prefix and its unit is a wheel or a side.
struct ColumnFamily {
  std::string_view prefix;
  std::vector<ColumnUnit> units;
  ValueRange allowed;
};

const std::vector<ColumnFamily>& families() {
  static const std::vector<ColumnFamily> kFamilies{
      {"wheel_speed_", {{"_rad_s", "_rad_s", 1}, {"_rpm", "_rad_s", kRpm}}, {-1e5, 1e5}},
      {"steer_", {{"_deg", "_rad", kDegree}}, {-360, 360}},
      {"torque_", {{"_nm", "_nm", 1}}, {-1e6, 1e6}},
      {"current_", {{"_a", "_a", 1}}, {-1e5, 1e5}},
      {"sinkage_", {{"_m", "_m", 1}}, {-5, 5}},
  };
  return kFamilies;
}

DriveColumnSource read_source(const std::string& name, const SettingsNode& node) {
  if (node.kind() == SettingsNode::Kind::kScalar) return {.name = name, .column = node.text()};
  return read_mapping(node, [&name](SettingsMapping& mapping) {
    DriveColumnSource source{.name = name, .column = mapping.required("column").text()};
    source.scale = mapping.number_or("scale", kAnyNumber, 1);
    source.offset = mapping.number_or("offset", kAnyNumber, 0);
    if (source.scale == 0) throw mapping.required("scale").not_allowed("any number but 0");
    if (const SettingsNode* fresh = mapping.optional("fresh")) source.fresh = fresh->text();
    return source;
  });
}

}  // namespace

std::optional<KnownDriveColumn> known_drive_column(std::string_view name) {
  struct Single {
    std::string_view name, channel;
    double per_unit;
    ValueRange allowed;
  };
  static const std::vector<Single> kSingles{
      {"time_s", "time_s", 1, {-1e12, 1e12}},
      {"x_m", "x_m", 1, {-1e9, 1e9}},
      {"y_m", "y_m", 1, {-1e9, 1e9}},
      {"yaw_deg", "yaw_rad", kDegree, {-1e6, 1e6}},
      {"roll_deg", "roll_rad", kDegree, {-360, 360}},
      {"pitch_deg", "pitch_rad", kDegree, {-360, 360}},
      {"curvature_1pm", "curvature_1pm", 1, {-1e3, 1e3}},
      {"speed_mps", "speed_mps", 1, {-1e3, 1e3}},
      {"course_deg", "course_rad", kDegree, {-1e6, 1e6}},
      {"command_speed", "command_speed", 1, kAnyNumber},
      {"command_turn", "command_turn", 1, kAnyNumber},
      {"pass", "pass", 1, {0, 1e6}},
  };
  for (const Single& single : kSingles) {
    if (single.name == name) {
      return KnownDriveColumn{std::string(single.channel), single.per_unit, single.allowed};
    }
  }
  for (const ColumnFamily& family : families()) {
    if (!name.starts_with(family.prefix)) continue;
    for (const ColumnUnit& unit : family.units) {
      if (!name.ends_with(unit.suffix)) continue;
      if (name.size() <= family.prefix.size() + unit.suffix.size()) continue;
      const std::string_view stem = name.substr(0, name.size() - unit.suffix.size());
      return KnownDriveColumn{std::string(stem) + std::string(unit.held), unit.per_unit,
                              family.allowed};
    }
  }
  return {};
}

DriveColumnMap read_drive_columns(const SettingsNode& node) {
  return read_mapping(node, [](SettingsMapping& mapping) {
    DriveColumnMap map;
    if (const SettingsNode* columns = mapping.optional("columns")) {
      for (const SettingsEntry& entry : columns->mapping()) {
        if (!known_drive_column(entry.key) && entry.key != "drive_id" && entry.key != "day") {
          throw entry.value.error(
              entry.key +
              " is no column of a drive (time_s, x_m, y_m, yaw_deg, roll_deg, "
              "pitch_deg, wheel_speed_<wheel>_rad_s or _rpm, steer_<wheel>_deg, "
              "curvature_1pm, torque_<wheel>_nm, current_<wheel>_a, "
              "sinkage_<wheel>_m, speed_mps, course_deg, command_speed, command_turn, "
              "pass, day, drive_id)");
        }
        map.sources.push_back(read_source(entry.key, entry.value));
      }
    }
    if (const SettingsNode* quaternion = mapping.optional("attitude_quaternion")) {
      map.quaternion = read_mapping(*quaternion, [](SettingsMapping& keys) {
        return std::array<std::string, 4>{keys.required("w").text(), keys.required("x").text(),
                                          keys.required("y").text(), keys.required("z").text()};
      });
    }
    return map;
  });
}

DriveColumnMap read_drive_columns_file(const std::string& file) {
  return read_drive_columns(read_settings(file));
}

}  // namespace regoplan
