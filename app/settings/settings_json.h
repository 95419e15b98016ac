#pragma once

#include <nlohmann/json_fwd.hpp>

#include "app/settings/settings_node.h"

namespace regoplan {

/// What settings say, as JSON, keys in their order: a scalar that is not quoted is a number or a
/// truth where it reads as such, anything else text; nothing is null.
nlohmann::ordered_json to_json(const SettingsNode& settings);

}  // namespace regoplan
