#include "app/settings/earlier_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

namespace regoplan {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kScenario = "scenario";
constexpr const char* kModel = "model";

/// `name` as it is found from here, where it stands in a file of `folder`.
std::string from_here(const std::filesystem::path& folder, const std::string& name) {
  return (folder / name).lexically_normal().string();
}

ScenarioOverrides overrides_of(const Json& planner) {
  ScenarioOverrides overrides{.planner = planner.at("name").get<std::string>(),
                              .seed = planner.at("seed").get<std::uint64_t>(),
                              .candidates = planner.at("candidates").get<int>(),
                              .improve = planner.at("improve").get<bool>()};
  if (planner.contains("time_s")) overrides.time_s = planner["time_s"].get<double>();
  if (planner.contains("iterations")) {
    overrides.iterations = planner["iterations"].get<std::int64_t>();
  }
  return overrides;
}

EarlierPlan earlier_plan_of(const Json& json, const std::filesystem::path& file) {
  EarlierPlan earlier{.file = file,
                      .scenario = {},
                      .overrides = overrides_of(json.at("settings").at("planner")),
                      .margin_min = json.at("limits").at("margin_min").get<double>(),
                      .version = json.at("version").get<std::string>(),
                      .inputs = {},
                      .candidates = json.at("candidates").dump()};
  for (const Json& input : json.at("inputs")) {
    const std::string name = from_here(file.parent_path(), input.at("file").get<std::string>());
    const Json& digest = input.at("digest");
    earlier.inputs.push_back({.key = input.at("key").get<std::string>(),
                              .shown = name,
                              .digest = digest.is_null() ? "" : digest.get<std::string>()});
    if (earlier.inputs.back().key == kScenario) earlier.scenario = name;
    if (earlier.inputs.back().key == kModel) earlier.overrides.model_file = name;
  }
  return earlier;
}

}  // namespace

std::string seen_from(const std::filesystem::path& folder, const std::filesystem::path& shown) {
  if (shown.generic_string().starts_with("${")) return shown.generic_string();
  std::error_code none;
  // A relative folder that is yet to be made is taken for no place on its own.
  const std::filesystem::path near =
      std::filesystem::proximate(shown, std::filesystem::absolute(folder), none);
  return (none ? shown : near).generic_string();
}

EarlierPlan read_earlier_plan(const std::string& file) {
  if (!std::filesystem::exists(file)) throw InputError(file + ": no such file");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw InputError(file + ": cannot be read");
  EarlierPlan earlier;
  try {
    earlier = earlier_plan_of(Json::parse(stream), file);
  } catch (const Json::exception&) {
    throw InputError(file + ": is no plan.json that says how it came about");
  }
  if (earlier.scenario.empty()) {
    throw InputError(file + ": names no scenario (a demo is repeated by demo itself)");
  }
  return earlier;
}

std::vector<std::string> changes_since(const EarlierPlan& earlier,
                                       const std::vector<InputDigest>& inputs) {
  std::vector<std::string> changed;
  const auto differs = [](const std::vector<InputDigest>& others, const InputDigest& input) {
    const auto other = std::ranges::find(others, input.key, &InputDigest::key);
    return other == others.end() || other->digest != input.digest;
  };
  for (const InputDigest& input : earlier.inputs) {
    if (differs(inputs, input)) changed.push_back(input.key);
  }
  for (const InputDigest& input : inputs) {
    if (std::ranges::find(earlier.inputs, input.key, &InputDigest::key) == earlier.inputs.end()) {
      changed.push_back(input.key);
    }
  }
  if (earlier.version != REGOPLAN_VERSION) changed.emplace_back("version");
  return changed;
}

Json inputs_json(const std::vector<InputDigest>& inputs, const std::filesystem::path& folder) {
  Json list = Json::array();
  for (const InputDigest& input : inputs) {
    list.push_back({{"key", input.key},
                    {"file", seen_from(folder, input.shown)},
                    {"digest", input.digest.empty() ? Json(nullptr) : Json(input.digest)}});
  }
  return list;
}

}  // namespace regoplan
