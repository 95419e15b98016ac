#include "benchmarks/planner/campaign_runs.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "planner/search/search_processes.h"
#include "planner/verdict/verified_path.h"

namespace regoplan {

namespace fs = std::filesystem;

std::map<std::string, Scenario> feasible_scenarios(const CampaignSettings& settings) {
  std::map<std::string, Scenario> scenarios;
  for (const auto& entry : fs::directory_iterator(settings.scenarios)) {
    if (!entry.is_regular_file()) continue;
    const std::string name = entry.path().stem();
    const auto& wanted = settings.names;
    if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), name) == wanted.end()) continue;
    Scenario scenario = read_scenario(entry.path(), {});
    if (scenario.expectation == PlanStatus::kFeasible) scenarios.emplace(name, std::move(scenario));
  }
  return scenarios;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

TimedOutcome timed(const World& world, const SearchRun& run) {
  TimedOutcome result;
  bool given = false;
  const auto start = std::chrono::steady_clock::now();
  search_in_processes(
      world, 1,
      [&]() -> std::optional<SearchRun> {
        return std::exchange(given, true) ? std::nullopt : std::optional(run);
      },
      [&](const SearchRun&, const std::optional<SearchOutcome>& outcome) {
        result = {outcome, seconds_since(start)};
      },
      {});
  return result;
}

bool passes(const World& verdict, const World& searched,
            const std::vector<ControlSegment>& controls) {
  return verify(verdict, searched, {.planner = {}, .controls = controls}).candidate.verified.passed;
}

}  // namespace regoplan
