#include "app/settings/settings_json.h"

#include <charconv>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "terramech/tables/number_text.h"

namespace regoplan {
namespace {

nlohmann::ordered_json scalar_json(const SettingsNode& scalar) {
  const std::string& text = scalar.scalar();
  if (scalar.quoted()) return text;
  if (text == "true" || text == "false") return text == "true";
  std::int64_t whole = 0;  // stays whole: keys that count things take no 400.0
  const char* const end = text.data() + text.size();
  if (const auto read = std::from_chars(text.data(), end, whole);
      read.ec == std::errc() && read.ptr == end) {
    return whole;
  }
  if (const auto number = parse_number(text)) return *number;
  return text;
}

}  // namespace

nlohmann::ordered_json to_json(const SettingsNode& settings) {
  switch (settings.kind()) {
    case SettingsNode::Kind::kEmpty:
      return nullptr;
    case SettingsNode::Kind::kScalar:
      return scalar_json(settings);
    case SettingsNode::Kind::kList: {
      auto list = nlohmann::ordered_json::array();
      for (const SettingsNode& item : settings.list()) list.push_back(to_json(item));
      return list;
    }
    case SettingsNode::Kind::kMapping: {
      auto mapping = nlohmann::ordered_json::object();
      for (const SettingsEntry& entry : settings.mapping()) {
        mapping[entry.key] = to_json(entry.value);
      }
      return mapping;
    }
  }
  return nullptr;
}

}  // namespace regoplan
