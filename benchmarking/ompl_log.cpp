#include "benchmarking/ompl_log.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace regoplan {
namespace {

/// Text that does not break the grammar's separators.
std::string cell(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == ';' || c == '\n' || c == '|'; }, ',');
  return text;
}

void append_runs(std::string& log, const PlannerRuns& planner) {
  log += fmt::format("{} properties for each run\n", planner.properties.size());
  for (const std::string& property : planner.properties) log += property + "\n";
  log += fmt::format("{} runs\n", planner.runs.size());
  for (const RunRecord& run : planner.runs) {
    for (const std::string& property : planner.properties) {
      const auto value = run.outcome.properties.find(property);
      if (value != run.outcome.properties.end()) log += cell(value->second);
      log += "; ";
    }
    log += "\n";
  }
}

void append_progress(std::string& log, const PlannerRuns& planner) {
  if (planner.progress_properties.empty()) return;
  log += fmt::format("{} progress properties for each run\n", planner.progress_properties.size());
  for (const std::string& property : planner.progress_properties) log += property + "\n";
  log += fmt::format("{} runs\n", planner.runs.size());
  for (const RunRecord& run : planner.runs) {
    for (const std::vector<std::string>& sample : run.outcome.progress) {
      for (const std::string& value : sample) log += value + ",";
      log += ";";
    }
    log += "\n";
  }
}

}  // namespace

std::string ompl_log(const BenchmarkExperiment& experiment) {
  const JournalOrigin& origin = experiment.origin;
  std::string log =
      fmt::format("OMPL version {}\nExperiment {}\n", ompl_version(), experiment.name);
  log += fmt::format("{} experiment properties\n", experiment.parameters.size());
  for (const auto& [name, value] : experiment.parameters) {
    std::string plain = name;
    std::replace(plain.begin(), plain.end(), '.', '_');
    log += fmt::format("{} = {}\n", plain, value);
  }
  const std::uint64_t seed = experiment.planners.front().runs.front().key.seed;
  log += fmt::format(
      "Running on {}\nStarting at {}\n<<<|\nregoplan {}, suite {}\n|>>>\n<<<|\n{}\n|>>>\n"
      "{} is the random seed\n{} seconds per run\n{} MB per run\n{} runs per planner\n"
      "{} seconds spent to collect the data\n",
      origin.host, origin.started, origin.version, origin.suite, origin.cpu, seed,
      origin.bounds.time_s, origin.bounds.memory_mb, runs_per_planner(experiment),
      search_seconds(experiment));
  log += fmt::format("1 enum type\nstatus|{}\n", fmt::join(ompl_status_names(), "|"));
  log += fmt::format("{} planners\n", experiment.planners.size());
  for (const PlannerRuns& planner : experiment.planners) {
    log += fmt::format("{}\n{} common properties\n", planner.planner, planner.settings.size());
    for (const auto& [name, value] : planner.settings) log += fmt::format("{} = {}\n", name, value);
    append_runs(log, planner);
    append_progress(log, planner);
    log += ".\n";
  }
  return log;
}

}  // namespace regoplan
