#include "app/diagnose_drive/drive_setup.h"

#include <filesystem>

#include "app/settings/scenario_settings.h"
#include "app/settings/settings_mapping.h"
#include "app/settings/vehicle_settings.h"
#include "terramech/basics/angles.h"
#include "terramech/parameters/gravity_range.h"

namespace regoplan {
namespace {

DriveEstimate read_angle(const SettingsNode& node) {
  constexpr ValueRange kAngle{.min = -180, .max = 180};
  if (node.kind() != SettingsNode::Kind::kMapping) {
    throw node.error("{mean, std} in degrees is expected");
  }
  return read_mapping(node, [&](SettingsMapping& mapping) {
    return DriveEstimate{mapping.number("mean", kAngle) * kDegree,
                         mapping.number("std", kAbove0) * kDegree};
  });
}

DriveEstimate read_number(const SettingsNode& node) {
  if (node.kind() != SettingsNode::Kind::kMapping) throw node.error("{mean, std} is expected");
  return read_mapping(node, [&](SettingsMapping& mapping) {
    return DriveEstimate{mapping.number("mean", kAbove0), mapping.number("std", kAbove0)};
  });
}

/// Numbers of the vehicle that nobody knows well: their means take the place of the vehicle's own.
void read_uncertain(const SettingsNode& node, DriveSetup& setup) {
  if (!setup.vehicle) throw node.error("the scenario has no vehicle whose numbers these could be");
  Vehicle& vehicle = *setup.vehicle;
  read_mapping(node, [&](SettingsMapping& keys) {
    if (const SettingsNode* mass = keys.optional("mass_kg")) {
      setup.uncertain.mass_kg = read_number(*mass);
      vehicle.mass_kg = setup.uncertain.mass_kg->value;
    }
    if (const SettingsNode* radius = keys.optional("wheel_radius_m")) {
      setup.uncertain.wheel_radius_m = read_number(*radius);
      vehicle.wheel.radius_m = setup.uncertain.wheel_radius_m->value;
    }
    if (const SettingsNode* motor = keys.optional("motor_constant")) {
      setup.uncertain.motor_constant = read_number(*motor);
    }
    validate(vehicle);
    return true;
  });
}

constexpr ValueRange kWindow_s{.min = 1, .max = 600};

void read_setup_keys(const std::string& file, DriveSetup& setup) {
  read_mapping(read_settings(file), [&](SettingsMapping& mapping) {
    if (const SettingsNode* mounting = mapping.optional("mounting")) {
      read_mapping(*mounting, [&](SettingsMapping& keys) {
        if (const auto* pitch = keys.optional("pitch_deg")) {
          setup.mounting_pitch_rad = read_angle(*pitch);
        }
        if (const auto* roll = keys.optional("roll_deg"))
          setup.mounting_roll_rad = read_angle(*roll);
        return true;
      });
    }
    if (const SettingsNode* vehicle = mapping.optional("vehicle")) read_uncertain(*vehicle, setup);
    if (mapping.optional("window_s")) setup.window_s = mapping.number("window_s", kWindow_s);
    return true;
  });
}

}  // namespace

DriveSetupFile read_drive_setup(const std::string& scenario_file,
                                const std::optional<std::string>& setup_file) {
  const SettingsNode root = read_settings(scenario_file);
  const SettingsNode* map_node = root.find("map");
  if (!map_node) throw root.error("map is missing");
  const std::filesystem::path folder = std::filesystem::path(scenario_file).parent_path();
  ScenarioMap map = read_map(*map_node, folder, WheelVariant::kIshigami2007);
  DriveSetupFile read{.setup = {.map = std::move(map.map), .vehicle = {}},
                      .limits = {},
                      .notices = std::move(map.notices)};
  for (const SettingsEntry& entry : root.mapping()) {
    if (entry.key == "gravity_mps2") read.setup.gravity_mps2 = entry.value.number(kGravity_mps2);
    if (entry.key == "vehicle") {
      read.setup.vehicle = placed(entry.value, [&] {
        return entry.value.kind() == SettingsNode::Kind::kMapping
                   ? read_vehicle(entry.value)
                   : named_vehicle(entry.value, folder);
      });
    }
  }
  if (setup_file) read_setup_keys(*setup_file, read.setup);
  if (read.setup.vehicle) {
    const Limits usual = default_limits(*read.setup.vehicle);
    const SettingsNode* limits = root.find("limits");
    read.limits = limits ? read_limits(*limits, usual) : usual;
  }
  if (read.setup.vehicle && read.setup.gravity_mps2 == 0) {
    throw root.error("gravity_mps2 is missing: a vehicle needs it");
  }
  return read;
}

}  // namespace regoplan
