#pragma once

#include "app/settings/scenario_settings.h"

namespace regoplan {

/// The built-in scenario: an LRV-class vehicle at up to 3 m/s across a cratered lunar plain with
/// three soils and rocks. Always the same.
PlanningProblem demo_problem(const ScenarioOverrides& overrides);

}  // namespace regoplan
