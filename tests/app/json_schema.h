#pragma once

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace regoplan {

/// What of a document a JSON schema does not allow, one line a place. Knows the keywords that the
/// schemas of docs/schemas use; another is an error of the schema, so that none is taken for kept.
class SchemaCheck {
 public:
  explicit SchemaCheck(nlohmann::json schema) : root_(std::move(schema)) {}

  std::vector<std::string> errors(const nlohmann::json& document) {
    found_.clear();
    check(root_, document, "");
    return found_;
  }

 private:
  using Json = nlohmann::json;

  void complain(const std::string& place, const std::string& what) {
    found_.push_back((place.empty() ? "/" : place) + ": " + what);
  }

  static bool is_a(const Json& value, const std::string& type) {
    if (type == "null") return value.is_null();
    if (type == "boolean") return value.is_boolean();
    if (type == "integer") return value.is_number_integer();
    if (type == "number") return value.is_number();
    if (type == "string") return value.is_string();
    if (type == "array") return value.is_array();
    return type == "object" && value.is_object();
  }

  void check_type(const Json& types, const Json& value, const std::string& place) {
    const Json list = types.is_array() ? types : Json::array({types});
    const bool any = std::ranges::any_of(
        list, [&](const Json& type) { return is_a(value, type.get<std::string>()); });
    if (!any) complain(place, value.dump().substr(0, 60) + " is not of the type " + list.dump());
  }

  void check_object(const Json& schema, const Json& value, const std::string& place) {
    for (const Json& key : schema.value("required", Json::array())) {
      if (!value.contains(key.get<std::string>())) complain(place, key.dump() + " is missing");
    }
    const Json properties = schema.value("properties", Json::object());
    const Json others = schema.value("additionalProperties", Json(true));
    for (const auto& [key, member] : value.items()) {
      if (properties.contains(key)) {
        check(properties.at(key), member, place + "/" + key);
      } else if (others.is_object()) {
        check(others, member, place + "/" + key);
      } else if (others == false) {
        complain(place, "\"" + key + "\" is not in the schema");
      }
    }
  }

  void check_limits(const Json& schema, const Json& value, const std::string& place) {
    if (schema.contains("enum") && std::ranges::find(schema["enum"], value) == schema["enum"].end())
      complain(place, value.dump() + " is none of " + schema["enum"].dump());
    if (schema.contains("minimum") && value.is_number() && value < schema["minimum"])
      complain(place, value.dump() + " is below " + schema["minimum"].dump());
    if (schema.contains("maximum") && value.is_number() && value > schema["maximum"])
      complain(place, value.dump() + " is above " + schema["maximum"].dump());
    if (schema.contains("pattern") && value.is_string() &&
        !std::regex_search(value.get<std::string>(),
                           std::regex(schema["pattern"].get<std::string>())))
      complain(place, value.dump() + " does not match " + schema["pattern"].dump());
  }

  void check(const Json& schema, const Json& value, const std::string& place) {
    static const std::set<std::string> known{
        "$schema",  "$id",         "$ref",       "$defs",
        "title",    "description", "type",       "enum",
        "required", "items",       "anyOf",      "minimum",
        "maximum",  "pattern",     "properties", "additionalProperties"};
    for (const auto& [keyword, content] : schema.items()) {
      if (!known.contains(keyword))
        complain(place, "the schema's keyword " + keyword + " is not known");
    }
    if (schema.contains("$ref")) {
      const std::string pointer = schema["$ref"].get<std::string>().substr(1);
      return check(root_.at(Json::json_pointer(pointer)), value, place);
    }
    if (schema.contains("anyOf")) {
      const bool any = std::ranges::any_of(schema["anyOf"], [&](const Json& one) {
        SchemaCheck alone(root_);
        alone.check(one, value, place);
        return alone.found_.empty();
      });
      if (!any) complain(place, "is none of what it may be");
    }
    if (schema.contains("type")) check_type(schema["type"], value, place);
    check_limits(schema, value, place);
    if (value.is_object()) check_object(schema, value, place);
    if (value.is_array() && schema.contains("items")) {
      for (std::size_t i = 0; i < value.size(); ++i) {
        check(schema["items"], value[i], place + "/" + std::to_string(i));
      }
    }
  }

  Json root_;
  std::vector<std::string> found_;
};

/// One of docs/schemas, `plan`.
inline SchemaCheck schema(const std::string& name) {
  std::ifstream stream("docs/schemas/" + name + ".schema.json");
  return SchemaCheck(nlohmann::json::parse(stream));
}

}  // namespace regoplan
