#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/settings/input_files.h"
#include "app/settings/settings_node.h"
#include "planner/problem/plan_result.h"
#include "planner/problem/planning_problem.h"

namespace regoplan {

inline constexpr int kThreadsMax = 256;

/// Of a search that is given neither a time nor iterations.
inline constexpr double kSearchTimeDefault_s = 20;

/// What a command line says in place of the scenario.
struct ScenarioOverrides {
  std::optional<std::string> model_file{};
  std::optional<std::string> planner{};
  std::optional<std::uint64_t> seed{};
  std::optional<double> time_s{};            ///< takes the place of an iteration budget
  std::optional<std::int64_t> iterations{};  ///< takes the place of a time
  std::optional<int> candidates{};
  std::optional<bool> improve{};
  std::optional<int> threads{};  ///< else as many as the machine has
};

/// `search` with what the command line says in its place; the default time where neither gives a
/// budget, as many threads as the machine has cores.
Search overridden(Search search, const ScenarioOverrides& overrides);

struct Scenario {
  PlanningProblem problem;
  std::vector<std::string> notices;       ///< for the person: what was taken to be so
  std::optional<PlanStatus> expectation;  ///< what the scenario says that it should come to
  std::vector<InputFile> inputs = {};     ///< what it was read from, the scenario first
};

struct ScenarioMap {
  TerrainMap map;
  std::vector<std::string> notices;
  std::vector<InputFile> inputs = {};
};

/// Reads SCENARIO.yaml and every file that it names, relative to it, and checks the whole.
/// \throws SettingsError
Scenario read_scenario(const std::string& file, const ScenarioOverrides& overrides);

/// Reads the `limits` of a scenario. \param defaults where a limit is not given
Limits read_limits(const SettingsNode& node, const Limits& defaults);

/// Reads only the `map` of a scenario.
ScenarioMap read_scenario_map(const std::string& file);

/// Reads a map `{elevation, soil_class, soils, rocks}` with file names relative to `folder`, or
/// `{terrain, soils}` with a terrain that stands in the scenario itself (`read_terrain`).
/// \param wheel_width_m where it is given, every soil must carry wheels of that width
ScenarioMap read_map(const SettingsNode& node, const std::filesystem::path& folder,
                     WheelVariant variant, std::optional<double> wheel_width_m = std::nullopt);

}  // namespace regoplan
