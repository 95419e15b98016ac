#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "app/settings/settings_node.h"
#include "terramech/basics/value_range.h"
#include "terramech/parameters/vehicle.h"

namespace regoplan {

/// A number of a vehicle: its key, where it is held, the SI value of the file's unit, its range.
struct VehicleNumber {
  std::string_view key;
  double Vehicle::*member;
  double unit;
  ValueRange allowed;
};
/// Those that stand directly in a vehicle's file and that every vehicle has.
std::span<const VehicleNumber> vehicle_numbers();

/// Reads a vehicle: the fields of `Vehicle` under their names, angles in degrees
/// (`steer_angle_max_deg`).
Vehicle read_vehicle(const SettingsNode& node);

/// The vehicle that a settings value names: a preset, or a vehicle file relative to `folder`.
Vehicle named_vehicle(const SettingsNode& name, const std::filesystem::path& folder);

/// The vehicle as a vehicle file that reads back to the same vehicle, bit for bit.
std::string vehicle_text(const Vehicle& vehicle);

}  // namespace regoplan
