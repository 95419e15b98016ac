#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "app/settings/scenario_settings.h"

namespace regoplan {

/// A plan that is to be repeated or exported: what its plan.json says of how it came about.
struct EarlierPlan {
  std::filesystem::path file;
  std::string scenario;         ///< its file, as it is found from here
  ScenarioOverrides overrides;  ///< planner, seed, budget, candidates and model that it had
  double margin_min = 0;        ///< of its limits
  std::string version;
  std::vector<InputDigest> inputs;
  std::string candidates;  ///< as plan.json has them
};

/// \throws InputError where the file is no plan.json, or names no scenario
EarlierPlan read_earlier_plan(const std::string& file);

/// Which inputs are not as they were, by their keys; `version` where the program is not.
std::vector<std::string> changes_since(const EarlierPlan& earlier,
                                       const std::vector<InputDigest>& inputs);

/// `shown` as it is found from `folder`, which may be yet to be made; what begins with a variable
/// lies where that says.
std::string seen_from(const std::filesystem::path& folder, const std::filesystem::path& shown);

/// The inputs as plan.json states them, files relative to the folder that it lies in.
nlohmann::ordered_json inputs_json(const std::vector<InputDigest>& inputs,
                                   const std::filesystem::path& folder);

}  // namespace regoplan
