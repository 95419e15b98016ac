#pragma once

#include <optional>
#include <string>

#include "app/settings/settings_node.h"
#include "diagnosis/diagnosis.h"

namespace regoplan {

/// What SETUP.yaml says.
struct SetupSettings {
  DiagnosisSetup setup;
  std::optional<std::string> soil_name;  ///< for the corrected model: the soil of a map it replaces
};

/// Reads `{model, wheel: {radius_m, width_m}, gravity_mps2, soil: {<soil keys>}, soil_name, noise:
/// {<channel>: standard deviation}, mechanisms: []}`: a model file will do, as long as it has no
/// mechanisms. Noise counts where a recording has no replicates.
/// \throws InputError also where a soil's number looks like one of another unit
SetupSettings read_setup(const SettingsNode& node);
SetupSettings read_setup_file(const std::string& file);

}  // namespace regoplan
