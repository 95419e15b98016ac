#pragma once

#include <optional>
#include <string>
#include <vector>

#include "drive_diagnosis/drive_diagnosis.h"
#include "planner/problem/limits.h"

namespace regoplan {

/// Map, vehicle and what is known of them, from a scenario and an optional setup.
struct DriveSetupFile {
  DriveSetup setup;
  Limits limits;  ///< of the scenario, else of its vehicle
  std::vector<std::string> notices;
};

/// Reads `map`, `vehicle`, `gravity_mps2` and `limits` of a scenario (its start, goal and all else
/// play no part; without a vehicle only what needs none is diagnosed), and of the setup
///
///     mounting: {pitch_deg: {mean, std}, roll_deg: {mean, std}}   # of the attitude sensor
///     vehicle: {mass_kg: {mean, std}, wheel_radius_m: {mean, std}, motor_constant: {mean, std}}
///     window_s: 3                                   # 1 to 600; else as the drives' speeds take
///
/// \throws SettingsError
DriveSetupFile read_drive_setup(const std::string& scenario_file,
                                const std::optional<std::string>& setup_file);

}  // namespace regoplan
