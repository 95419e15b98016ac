#pragma once

#include <string>

#include "app/settings/scenario_settings.h"

namespace regoplan {

/// The built-in scenario: an LRV-class vehicle at up to 3 m/s across a cratered lunar plain with
/// three soils and rocks. Always the same.
PlanningProblem demo_problem(const ScenarioOverrides& overrides);

/// The same as a scenario beside the files of its map (`write_map_files`).
std::string demo_scenario_text();

}  // namespace regoplan
