#include "benchmarking/suite.h"

#include <fmt/format.h>

namespace regoplan {

std::string experiment_name(const Suite& suite, std::size_t scenario, std::size_t sweep_point) {
  std::string name = suite.scenarios[scenario].label;
  for (const auto& [key, value] : suite.sweep[sweep_point]) {
    name += fmt::format(",{}={}", key, value);
  }
  return name;
}

std::vector<SuiteRun> runs_of(const Suite& suite, const Shard& shard) {
  std::vector<SuiteRun> runs;
  const auto count = static_cast<std::size_t>(shard.count);
  const auto mine = static_cast<std::size_t>(shard.index - 1);
  std::size_t number = 0;
  for (std::size_t scenario = 0; scenario < suite.scenarios.size(); ++scenario) {
    for (std::size_t point = 0; point < suite.sweep.size(); ++point) {
      for (const std::uint64_t seed : suite.seeds) {
        for (std::size_t planner = 0; planner < suite.planners.size(); ++planner) {
          if (number++ % count == mine) {
            runs.push_back(
                {.scenario = scenario, .sweep_point = point, .planner = planner, .seed = seed});
          }
        }
      }
    }
  }
  return runs;
}

}  // namespace regoplan
