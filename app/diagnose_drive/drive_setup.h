#pragma once

#include <optional>
#include <string>
#include <vector>

#include "drive_diagnosis/drive_diagnosis.h"

namespace regoplan {

/// Map, vehicle and what is known of them, from a scenario and an optional setup.
struct DriveSetupFile {
  DriveSetup setup;
  std::vector<std::string> notices;
};

/// Reads `map`, `vehicle` and `gravity_mps2` of a scenario (its start, goal and all else play no
/// part; without a vehicle only what needs none is diagnosed), and of the setup
///
///     mounting: {pitch_deg: {mean, std}, roll_deg: {mean, std}}   # of the attitude sensor
///     window_s: 3                                   # 1 to 20; with a vehicle else 5
///
/// \throws SettingsError
DriveSetupFile read_drive_setup(const std::string& scenario_file,
                                const std::optional<std::string>& setup_file);

}  // namespace regoplan
