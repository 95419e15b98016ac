#include "benchmarking/experiment.h"

#include <algorithm>
#include <set>

namespace regoplan {
namespace {

/// `crater_rim,speed_mps.max=2` to its scenario and parameters.
void read_name(BenchmarkExperiment& experiment) {
  std::size_t at = experiment.name.find(',');
  while (at != std::string::npos) {
    const std::size_t end = experiment.name.find(',', at + 1);
    const std::string item = experiment.name.substr(at + 1, end - at - 1);
    const std::size_t equals = item.find('=');
    experiment.parameters[item.substr(0, equals) + " REAL"] = item.substr(equals + 1);
    at = end;
  }
}

const JournalOrigin& origin_of(const JournalContents& contents, const std::string& experiment) {
  const std::string scenario = experiment.substr(0, experiment.find(','));
  const auto found = std::find_if(
      contents.origins.begin(), contents.origins.end(),
      [&](const JournalOrigin& origin) { return origin.scenarios.contains(scenario); });
  return found == contents.origins.end() ? contents.origins.front() : *found;
}

std::vector<std::string> planner_order(const JournalContents& contents) {
  std::vector<std::string> order;
  const auto add = [&](const std::string& label) {
    if (std::find(order.begin(), order.end(), label) == order.end()) order.push_back(label);
  };
  for (const JournalOrigin& origin : contents.origins) {
    for (const SuitePlanner& planner : origin.planners) add(planner.label);
  }
  return order;
}

/// OMPL gives progress in the order of the names; its readers expect the time first.
void put_time_first(BenchmarkRecord& record) {
  std::vector<std::string>& names = record.progress_names;
  const auto time = std::find(names.begin(), names.end(), "time REAL");
  if (time == names.end()) return;
  const auto place = time - names.begin();
  std::rotate(names.begin(), time, time + 1);
  for (std::vector<std::string>& sample : record.progress) {
    std::rotate(sample.begin(), sample.begin() + place, sample.begin() + place + 1);
  }
}

void describe(PlannerRuns& planner) {
  std::set<std::string> names;
  for (RunRecord& run : planner.runs) {
    put_time_first(run.outcome);
    for (const auto& [name, value] : run.outcome.properties) names.insert(name);
    if (planner.settings.empty()) planner.settings = run.outcome.settings;
    if (planner.progress_properties.empty()) {
      planner.progress_properties = run.outcome.progress_names;
    }
  }
  planner.properties = {names.begin(), names.end()};
  std::sort(planner.runs.begin(), planner.runs.end(),
            [](const RunRecord& a, const RunRecord& b) { return a.key < b.key; });
}

}  // namespace

double search_seconds(const BenchmarkExperiment& experiment) {
  double total = 0;
  for (const PlannerRuns& planner : experiment.planners) {
    for (const RunRecord& run : planner.runs) {
      total += number(run.outcome, "time REAL").value_or(0);
    }
  }
  return total;
}

std::size_t runs_per_planner(const BenchmarkExperiment& experiment) {
  std::size_t most = 0;
  for (const PlannerRuns& planner : experiment.planners) {
    most = std::max(most, planner.runs.size());
  }
  return most;
}

std::vector<BenchmarkExperiment> experiments_of(const JournalContents& contents) {
  std::map<std::string, std::map<std::string, PlannerRuns>> grouped;
  for (const RunRecord& run : contents.runs) {
    PlannerRuns& planner = grouped[run.key.experiment][run.key.planner];
    planner.planner = run.key.planner;
    planner.runs.push_back(run);
  }
  std::vector<BenchmarkExperiment> experiments;
  for (auto& [name, planners] : grouped) {
    BenchmarkExperiment experiment{
        .name = name, .parameters = {}, .origin = origin_of(contents, name), .planners = {}};
    read_name(experiment);
    for (const std::string& label : planner_order(contents)) {
      const auto planner = planners.find(label);
      if (planner == planners.end()) continue;
      describe(planner->second);
      experiment.planners.push_back(std::move(planner->second));
    }
    experiments.push_back(std::move(experiment));
  }
  return experiments;
}

}  // namespace regoplan
