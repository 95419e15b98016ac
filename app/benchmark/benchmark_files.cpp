#include "app/benchmark/benchmark_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "app/benchmark/optional_json.h"
#include "app/io/staged_files.h"
#include "benchmarking/ompl_log.h"
#include "benchmarking/results_database.h"
#include "benchmarking/summary.h"

namespace regoplan {
namespace {

nlohmann::json json_of(const PlannerSummary& summary) {
  return {{"planner", summary.planner},
          {"runs", summary.runs},
          {"verified", summary.verified},
          {"overturned", summary.overturned},
          {"crashed", summary.crashed},
          {"success_ci95", summary.success_ci95},
          {"time_median_s", or_null(summary.time_median_s)},
          {"length_median_m", or_null(summary.length_median_m)},
          {"duration_median_s", or_null(summary.duration_median_s)},
          {"energy_median_j", or_null(summary.energy_median_j)},
          {"margin_median", or_null(summary.margin_median)},
          {"propagations_median", or_null(summary.propagations_median)},
          {"medians_ci95", summary.medians_ci95}};
}

nlohmann::json json_of(const PairedComparison& pair) {
  return {{"experiment", pair.experiment}, {"planner", pair.planner}, {"other", pair.other},
          {"property", pair.property},     {"pairs", pair.pairs},     {"ratio", pair.ratio},
          {"ratio_ci95", pair.ratio_ci95}, {"real", pair.real}};
}

/// Of all runs, each once, in their order.
std::set<std::uint64_t> seeds_of(const JournalContents& journal) {
  std::set<std::uint64_t> seeds;
  for (const RunRecord& run : journal.runs) seeds.insert(run.key.seed);
  return seeds;
}

/// What runs were bounded by and made of. A journal takes parts of one suite only: bounds are those
/// of each, and what has one label is one thing.
nlohmann::json settings_json(const JournalContents& journal) {
  nlohmann::json planners = nlohmann::json::object();
  for (const JournalOrigin& origin : journal.origins) {
    for (const SuitePlanner& planner : origin.planners) {
      planners[planner.label] = {{"planner", planner.planner}, {"parameters", planner.parameters}};
    }
  }
  const RunBounds& bounds = journal.origins.front().bounds;
  return {{"time_s", bounds.time_s},
          {"iterations", bounds.iterations ? nlohmann::json(*bounds.iterations) : nullptr},
          {"memory_mb", bounds.memory_mb},
          {"progress_interval_s", bounds.progress_interval_s},
          {"soil_draws", bounds.soil_draws},
          {"seeds", seeds_of(journal)},
          {"planners", planners}};
}

/// By label, what tells a scenario's files from others.
nlohmann::json scenarios_json(const JournalContents& journal) {
  nlohmann::json scenarios = nlohmann::json::object();
  for (const JournalOrigin& origin : journal.origins) scenarios.update(origin.scenarios);
  return scenarios;
}

/// An experiment's name as a file's.
std::string log_name(std::string experiment) {
  std::replace_if(
      experiment.begin(), experiment.end(), [](char c) { return c == ',' || c == '='; }, '_');
  return experiment + ".log";
}

}  // namespace

std::string benchmark_json(const SuiteResults& results) {
  nlohmann::json experiments = nlohmann::json::array();
  nlohmann::json comparisons = nlohmann::json::array();
  for (const BenchmarkExperiment& experiment : results.experiments) {
    nlohmann::json planners = nlohmann::json::array();
    for (const PlannerRuns& runs : experiment.planners) {
      planners.push_back(json_of(summary_of(runs)));
    }
    experiments.push_back({{"name", experiment.name}, {"planners", planners}});
    for (const char* property : {"time REAL", "path length m REAL"}) {
      for (const PairedComparison& pair : paired_comparisons(experiment, property)) {
        comparisons.push_back(json_of(pair));
      }
    }
  }
  const std::vector<JournalOrigin>& origins = results.journal.origins;
  const nlohmann::json json{{"suite", origins.front().suite},
                            {"runs", results.journal.runs.size()},
                            {"interrupted", results.interrupted},
                            {"version", origins.back().version},
                            {"experiments", experiments},
                            {"comparisons", comparisons},
                            {"settings", settings_json(results.journal)},
                            {"scenarios", scenarios_json(results.journal)}};
  return json.dump(2) + "\n";
}

std::vector<std::string> benchmark_file_names() {
  return {"benchmark.db", "benchmark.json", "report.html"};
}

void write_benchmark_files(const SuiteResults& results, const ScenarioMaps& maps,
                           const ResultFolder& folder) {
  StagedFiles staged(folder);
  for (const BenchmarkExperiment& experiment : results.experiments) {
    staged.write({.name = log_name(experiment.name), .content = ompl_log(experiment)});
  }
  write_results_database(staged.path("benchmark.db"), results.experiments);
  staged.write({.name = "benchmark.json", .content = benchmark_json(results)});
  staged.write({.name = "report.html", .content = benchmark_report(results, maps)});
  staged.commit();
}

}  // namespace regoplan
