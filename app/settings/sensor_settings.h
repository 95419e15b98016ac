#pragma once

#include <string>

#include "driving/sensors.h"

namespace regoplan {

/// Reads a sensors file, docs/drive.md. \throws SettingsError
SensorSuite read_sensors(const std::string& file);

/// The file that `--sensors` names: `A` and `B` are the grades that come with the program.
std::string sensors_file(const std::string& name);

}  // namespace regoplan
