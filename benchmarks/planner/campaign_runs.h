#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/settings/scenario_settings.h"
#include "benchmarks/planner/campaigns.h"
#include "planner/ompl/search_run.h"

namespace regoplan {

/// The scenarios asked for that a path is expected in, by name.
std::map<std::string, Scenario> feasible_scenarios(const CampaignSettings& settings);

double seconds_since(std::chrono::steady_clock::time_point start);

struct TimedOutcome {
  std::optional<SearchOutcome> outcome;
  double time_s = 0;  ///< the process included
};

/// One run in a process of its own.
TimedOutcome timed(const World& world, const SearchRun& run);

/// Whether the path passes verification.
bool passes(const World& verdict, const World& searched,
            const std::vector<ControlSegment>& controls);

}  // namespace regoplan
