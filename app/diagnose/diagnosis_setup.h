#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/settings/settings_node.h"
#include "diagnosis/diagnosis.h"

namespace regoplan {

/// What SETUP.yaml says.
struct SetupSettings {
  DiagnosisSetup setup;
  std::optional<std::string> soil_name;  ///< for the corrected model: the soil of a map it replaces
  std::vector<std::string> warnings;     ///< numbers whose unit is doubtful, a sentence each
};

/// What lugs can be, as their mechanism has it.
/// \param parameter `lug_height_m` or `lugs`
ValueRange of_lugs(std::string_view parameter);

/// Reads `{model, wheel: {radius_m, width_m, lug_height_m, lug_count}, gravity_mps2, soil: {<soil
/// keys>}, soil_name, noise:
/// {<channel>: standard deviation}, mechanisms: []}`: a model file will do, as long as it has no
/// mechanisms. Lugs are those of the test, not of references. Noise counts where a recording has no
/// replicates.
SetupSettings read_setup(const SettingsNode& node);
SetupSettings read_setup_file(const std::string& file);

}  // namespace regoplan
