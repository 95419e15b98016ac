#include "python/shared/settings_text.h"

#include <nlohmann/json.hpp>

#include "app/io/number_text.h"

namespace regoplan::python {
namespace {

nlohmann::ordered_json value_of(const SettingsNode& node) {
  switch (node.kind()) {
    case SettingsNode::Kind::kEmpty:
      return nullptr;
    case SettingsNode::Kind::kScalar: {
      const std::string text = node.text();
      if (text == "true" || text == "false") return text == "true";
      if (const auto number = parse_number(text)) return *number;
      return text;
    }
    case SettingsNode::Kind::kList: {
      auto list = nlohmann::ordered_json::array();
      for (const SettingsNode& item : node.list()) list.push_back(value_of(item));
      return list;
    }
    case SettingsNode::Kind::kMapping: {
      auto mapping = nlohmann::ordered_json::object();
      for (const SettingsEntry& entry : node.mapping()) mapping[entry.key] = value_of(entry.value);
      return mapping;
    }
  }
  return nullptr;
}

}  // namespace

SettingsNode settings_of(const std::string& json, const std::string& what) {
  return parse_settings(json, "<" + what + ">");
}

std::string json_of(const SettingsNode& settings) {
  return value_of(settings).dump();
}

}  // namespace regoplan::python
