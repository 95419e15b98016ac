#pragma once

#include <filesystem>

#include "app/settings_node.h"

namespace regoplan {

/// The file that a settings value names: relative to `folder`, with `${NAME}` standing for an
/// environment variable.
/// \throws SettingsError where the variable is not set
std::filesystem::path named_file(const SettingsNode& name, const std::filesystem::path& folder);

}  // namespace regoplan
