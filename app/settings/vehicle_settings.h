#pragma once

#include <filesystem>
#include <string>

#include "app/settings/settings_node.h"
#include "terramech/parameters/vehicle.h"

namespace regoplan {

/// Reads a vehicle: the fields of `Vehicle` under their names, angles in degrees
/// (`steer_angle_max_deg`).
Vehicle read_vehicle(const SettingsNode& node);

/// The vehicle that a settings value names: a preset, or a vehicle file relative to `folder`.
Vehicle named_vehicle(const SettingsNode& name, const std::filesystem::path& folder);

/// The vehicle as a vehicle file that reads back to the same vehicle, bit for bit.
std::string vehicle_text(const Vehicle& vehicle);

}  // namespace regoplan
