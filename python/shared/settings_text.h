#pragma once

#include <string>

#include "app/settings/settings_node.h"

namespace regoplan::python {

/// Settings that come from a Python dict, as JSON, which YAML contains: the readers of files check
/// them as they check files. Errors have `<what>:1` where a file's would have its name and line.
SettingsNode settings_of(const std::string& json, const std::string& what);

/// What a settings file says, as JSON: keys in its order, scalars as numbers and truths where they
/// read as such.
std::string json_of(const SettingsNode& settings);

}  // namespace regoplan::python
