#include "python/shared/settings_text.h"

#include <nlohmann/json.hpp>

#include "app/settings/settings_json.h"

namespace regoplan::python {

SettingsNode settings_of(const std::string& json, const std::string& what) {
  return parse_settings(json, "<" + what + ">");
}

std::string json_of(const SettingsNode& settings) {
  return to_json(settings).dump();
}

}  // namespace regoplan::python
