#include "app/benchmark/benchmark_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <set>

#include "app/benchmark/optional_json.h"
#include "app/page/report_assets.h"
#include "app/page/report_map.h"
#include "app/page/report_page.h"
#include "benchmarking/experiment.h"
#include "benchmarking/summary.h"

namespace regoplan {
namespace {

/// Every so manieth point, so that a page of many runs stays small.
nlohmann::json thinned(const std::vector<std::array<double, 3>>& path) {
  constexpr std::size_t kMost = 60;
  const std::size_t stride = path.size() / kMost + 1;
  nlohmann::json points = nlohmann::json::array();
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (i % stride != 0 && i + 1 != path.size()) continue;
    points.push_back({std::round(10 * path[i][0]) / 10, std::round(10 * path[i][1]) / 10,
                      std::round(1000 * path[i][2]) / 1000});
  }
  return points;
}

nlohmann::json json_of(const RunRecord& run, bool with_path) {
  const BenchmarkRecord& outcome = run.outcome;
  nlohmann::json json{{"seed", run.key.seed},
                      {"verified", solved_and_verified(outcome)},
                      {"overturned", number(outcome, "overturned BOOLEAN") == 1},
                      {"crashed", number(outcome, "status ENUM") == ompl_crash_status()},
                      {"time_s", or_null(number(outcome, "time REAL"))},
                      {"first_solution_s", or_null(first_solution_s(outcome))},
                      {"length_m", or_null(number(outcome, "path length m REAL"))},
                      {"duration_s", or_null(number(outcome, "path duration s REAL"))},
                      {"energy_j", or_null(number(outcome, "path energy j REAL"))},
                      {"margin_min", or_null(number(outcome, "margin min REAL"))},
                      {"margin_p05", or_null(number(outcome, "margin p05 REAL"))},
                      {"propagations", or_null(number(outcome, "propagations INTEGER"))}};
  if (with_path) json["path"] = thinned(outcome.path);
  if (!outcome.progress.empty()) {
    json["progress_names"] = outcome.progress_names;
    json["progress"] = outcome.progress;
  }
  return json;
}

nlohmann::json json_of(const BenchmarkExperiment& experiment) {
  // A page under 5 MB: the paths of the first seeds stand for all.
  constexpr std::size_t kPathsPerPlanner = 10;
  nlohmann::json planners = nlohmann::json::array();
  for (const PlannerRuns& runs : experiment.planners) {
    const PlannerSummary summary = summary_of(runs);
    nlohmann::json list = nlohmann::json::array();
    for (std::size_t i = 0; i < runs.runs.size(); ++i) {
      list.push_back(json_of(runs.runs[i], i < kPathsPerPlanner));
    }
    planners.push_back({{"name", runs.planner},
                        {"success_ci95", summary.success_ci95},
                        {"settings", runs.settings},
                        {"runs", std::move(list)}});
  }
  nlohmann::json comparisons = nlohmann::json::array();
  for (const char* property : {"time REAL", "path length m REAL"}) {
    for (const PairedComparison& pair : paired_comparisons(experiment, property)) {
      comparisons.push_back({{"planner", pair.planner},
                             {"other", pair.other},
                             {"property", pair.property},
                             {"pairs", pair.pairs},
                             {"ratio", pair.ratio},
                             {"ratio_ci95", pair.ratio_ci95},
                             {"real", pair.real}});
    }
  }
  return {{"name", experiment.name},
          {"planners", std::move(planners)},
          {"comparisons", std::move(comparisons)}};
}

/// The scenario's label: what a sweep adds to an experiment's name follows a comma.
std::string scenario_of(const std::string& experiment) {
  return experiment.substr(0, experiment.find(','));
}

nlohmann::json maps_json(const ScenarioMaps& maps) {
  // A page under 5 MB: small pictures, and no more of them than a person looks at.
  constexpr ReportMapDetail kSmall{.cells_a_side = 128, .rocks = 800};
  constexpr std::size_t kMapsMax = 20;
  nlohmann::json all = nlohmann::json::object();
  for (const auto& [label, map] : maps) {
    if (all.size() == kMapsMax) break;
    all[label] = report_map(map, kSmall);
  }
  return all;
}

struct Totals {
  int runs = 0, verified = 0, overturned = 0, crashed = 0;
};

Totals totals_of(const std::vector<BenchmarkExperiment>& experiments) {
  Totals totals;
  for (const BenchmarkExperiment& experiment : experiments) {
    for (const PlannerRuns& runs : experiment.planners) {
      const PlannerSummary summary = summary_of(runs);
      totals.runs += summary.runs;
      totals.verified += summary.verified;
      totals.overturned += summary.overturned;
      totals.crashed += summary.crashed;
    }
  }
  return totals;
}

std::vector<std::string> lead_sentences(const JournalContents& contents, const Totals& totals,
                                        bool interrupted) {
  std::vector<std::string> sentences;
  if (interrupted) {
    sentences.emplace_back(
        "The suite was interrupted: these are the runs that had ended by then. The same command, "
        "or that of the shard, goes on from there.");
  }
  const RunBounds& bounds = contents.origins.front().bounds;
  sentences.push_back(fmt::format(
      "Each search was asked to stop after {} s{}, which some planners heed only at the end of a "
      "longer step, and had {} MB; each solution was driven again by the exact wheel model with a "
      "ten times finer step, and counts only where that confirms it.",
      bounds.time_s,
      bounds.iterations ? fmt::format(" (at most {} iterations)", *bounds.iterations) : "",
      bounds.memory_mb));
  if (totals.overturned > 0) {
    sentences.push_back(fmt::format("{} solution{} did not survive that replay.", totals.overturned,
                                    totals.overturned == 1 ? "" : "s"));
  }
  if (totals.crashed > 0) {
    sentences.push_back(fmt::format("{} run{} ended without an answer.", totals.crashed,
                                    totals.crashed == 1 ? "" : "s"));
  }
  std::set<std::string> machines, versions;
  for (const JournalOrigin& origin : contents.origins) {
    machines.insert(fmt::format("{} ({})", origin.host, origin.cpu));
    versions.insert(origin.version);
  }
  for (const std::string& machine : machines) sentences.push_back("Measured on " + machine + ".");
  if (versions.size() > 1) {
    sentences.emplace_back("The runs are of several versions of this program; compare with care.");
  }
  return sentences;
}

std::string headline(const SuiteResults& results, const Totals& totals) {
  const std::size_t experiments = results.experiments.size();
  return fmt::format("{}: {} of {} runs over {} {} found a path that the exact model confirms{}.",
                     results.journal.origins.front().suite, totals.verified, totals.runs,
                     experiments, experiments == 1 ? "experiment" : "experiments",
                     results.interrupted ? " (interrupted)" : "");
}

}  // namespace

std::string benchmark_headline(const SuiteResults& results) {
  return headline(results, totals_of(results.experiments));
}

std::string benchmark_report(const SuiteResults& results, const ScenarioMaps& maps) {
  const Totals totals = totals_of(results.experiments);
  const JournalOrigin& origin = results.journal.origins.front();
  nlohmann::json list = nlohmann::json::array();
  for (const BenchmarkExperiment& experiment : results.experiments) {
    list.push_back(json_of(experiment));
    list.back()["scenario"] = scenario_of(experiment.name);
  }
  return render({.command = "benchmark",
                 .title = "Benchmark " + origin.suite,
                 .headline = headline(results, totals),
                 .lead = lead_sentences(results.journal, totals, results.interrupted),
                 .body_html = report_assets::kBenchmarkHtml,
                 .script = report_assets::kBenchmarkScript,
                 .data_json = json_for_html({{"kind", "benchmark"},
                                             {"suite", origin.suite},
                                             {"time_s", origin.bounds.time_s},
                                             {"maps", maps_json(maps)},
                                             {"experiments", std::move(list)}})});
}

}  // namespace regoplan
