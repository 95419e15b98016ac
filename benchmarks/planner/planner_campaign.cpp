// What the planner reaches over many seeds and maps. Each campaign writes a CSV file, a row a run,
// goes on where it was stopped, and ends by printing its summary:
//   planner_campaign first_path   --out DIR [--seeds N] [--scenario NAME]...
//   planner_campaign cost         --out DIR [--seeds N] [--time S] [--scenario NAME]...
//   planner_campaign certificates --out DIR [--seeds N]
//   planner_campaign coverage     --out DIR [--seeds N] [--scenario NAME]...
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <map>
#include <utility>

#include "app/scenario_settings.h"
#include "benchmarks/planner/campaign_rows.h"
#include "benchmarks/planner/random_problem.h"
#include "planner/candidate.h"
#include "planner/plan.h"
#include "planner/relaxed_problem.h"
#include "planner/search_processes.h"
#include "planner/soil_uncertainty.h"

namespace regoplan {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

struct Settings {
  fs::path out;
  fs::path scenarios = "benchmarks/scenarios";
  std::vector<std::string> names;
  int seeds = 10;
  double time_s = 10;
};

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::string share_text(int successes, int runs) {
  const Probability share = probability_of(successes, runs);
  return fmt::format("{} of {} ({:.3f}, 95 % interval {:.3f} to {:.3f})", successes, runs,
                     share.share, share.low, share.high);
}

/// Nearest rank.
double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::nan("");
  std::sort(values.begin(), values.end());
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  return values[std::max<std::size_t>(rank, 1) - 1];
}

/// The scenarios that a path is expected in, by name.
std::map<std::string, Scenario> feasible_scenarios(const Settings& settings) {
  std::map<std::string, Scenario> scenarios;
  for (const auto& entry : fs::directory_iterator(settings.scenarios)) {
    const std::string name = entry.path().stem();
    const auto& wanted = settings.names;
    if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), name) == wanted.end()) continue;
    Scenario scenario = read_scenario(entry.path(), {});
    if (scenario.expectation == PlanStatus::kFeasible) scenarios.emplace(name, std::move(scenario));
  }
  return scenarios;
}

struct TimedOutcome {
  std::optional<SearchOutcome> outcome;
  double time_s = 0;
};

/// One run in a process of its own.
TimedOutcome timed(const World& world, const SearchRun& run) {
  TimedOutcome result;
  bool given = false;
  const Clock::time_point start = Clock::now();
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

double duration_s(const SearchOutcome& outcome) {
  double sum = 0;
  for (const ControlSegment& segment : outcome.controls) sum += segment.duration_s;
  return sum;
}

/// What the part of a key before the first or after the last of its separators says.
std::string first_part(const std::string& key) {
  return key.substr(0, key.find(':'));
}
std::string last_part(const std::string& key) {
  return key.substr(key.rfind(':') + 1);
}

void first_path(const Settings& settings) {
  CampaignRows rows(settings.out / "first_path.csv",
                    {"found", "time_s", "propagations", "passed", "verification_s"});
  for (const auto& [name, scenario] : feasible_scenarios(settings)) {
    const PlanningProblem& problem = scenario.problem;
    const World world(problem, WorldUse::kSearch, 2), verdict(problem, WorldUse::kVerdict, 2);
    for (int seed = 1; seed <= settings.seeds; ++seed) {
      const std::string key = fmt::format("{}:{}", name, seed);
      if (rows.has(key)) continue;
      // The lattice draws nothing; the way that guides it does.
      const TimedOutcome run =
          timed(world, {.planner = "Lattice",
                        .guidance = {.seed = static_cast<std::uint64_t>(seed),
                                     .margin_min = problem.limits.margin_min + 0.03,
                                     .variety = 1},
                        .time_s = settings.time_s,
                        .iterations = {}});
      const bool found = run.outcome && !run.outcome->controls.empty();
      const Clock::time_point start = Clock::now();
      const bool passed =
          found &&
          !verify_all(verdict, world, {{.planner = "Lattice", .controls = run.outcome->controls}},
                      [](const PlanProgress&) {})
               .passed.empty();
      rows.add(key, {static_cast<double>(found), run.time_s,
                     run.outcome ? static_cast<double>(run.outcome->propagations) : 0,
                     static_cast<double>(passed), seconds_since(start)});
    }
  }
  std::map<std::string, std::vector<const CampaignRows::Row*>> by_scenario;
  for (const CampaignRows::Row& row : rows.all()) {
    by_scenario[first_part(row.first)].push_back(&row);
    by_scenario["all"].push_back(&row);
  }
  for (const auto& [name, runs] : by_scenario) {
    std::vector<double> times;
    int found = 0, overturned = 0;
    for (const CampaignRows::Row* row : runs) {
      times.push_back(row->second[1]);
      found += row->second[0] > 0;
      overturned += row->second[0] > 0 && row->second[3] == 0;
    }
    fmt::print("{:>16}: median {:.3f} s, p90 {:.3f} s; found {}; overturned {}\n", name,
               quantile(times, 0.5), quantile(times, 0.9),
               share_text(found, static_cast<int>(runs.size())), share_text(overturned, found));
  }
}

void cost(const Settings& settings) {
  const std::vector<std::string> planners{"Lattice", "StableSparse", "StateCost",
                                          "SST",     "RRT",          "KPIECE1"};
  CampaignRows rows(settings.out / "cost.csv", {"cost", "propagations"});
  for (const auto& [name, scenario] : feasible_scenarios(settings)) {
    const PlanningProblem& problem = scenario.problem;
    const World world(problem, WorldUse::kSearch, 2);
    for (int seed = 1; seed <= settings.seeds; ++seed) {
      for (const std::string& planner : planners) {
        const std::string key = fmt::format("{}:{}:{}", name, seed, planner);
        if (rows.has(key)) continue;
        const TimedOutcome run =
            timed(world, {.planner = planner,
                          .guidance = {.seed = static_cast<std::uint64_t>(seed),
                                       .margin_min = problem.limits.margin_min + 0.03,
                                       .improve = true},
                          .time_s = settings.time_s,
                          .iterations = {}});
        const bool found = run.outcome && !run.outcome->controls.empty();
        rows.add(key, {found ? duration_s(*run.outcome) : INFINITY,
                       run.outcome ? static_cast<double>(run.outcome->propagations) : 0});
      }
    }
  }
  std::map<std::string, std::map<std::string, double>> by_run;  // scenario:seed, planner
  for (const CampaignRows::Row& row : rows.all()) {
    by_run[row.first.substr(0, row.first.rfind(':'))][last_part(row.first)] = row.second[0];
  }
  for (const char* own : {"Lattice", "StableSparse", "StateCost"}) {
    for (const char* stock : {"SST", "RRT", "KPIECE1"}) {
      int better = 0, pairs = 0;
      std::vector<double> ratios;
      for (const auto& [run, costs] : by_run) {
        if (!costs.contains(own) || !costs.contains(stock)) continue;
        ++pairs;
        better += costs.at(own) < costs.at(stock);
        if (std::isfinite(costs.at(stock))) ratios.push_back(costs.at(own) / costs.at(stock));
      }
      fmt::print("{:>12} cheaper than {:>7} in {}; median ratio {:.3f}\n", own, stock,
                 share_text(better, pairs), quantile(ratios, 0.5));
    }
  }
}

void certificates(const Settings& settings) {
  CampaignRows rows(settings.out / "certificates.csv", {"certified", "path"});
  for (int seed = 1; seed <= settings.seeds; ++seed) {
    const std::string key = fmt::format("{}", seed);
    if (rows.has(key)) continue;
    const PlanningProblem problem = random_problem(static_cast<std::uint64_t>(seed));
    const bool certified = certificate_of_infeasibility(problem).has_value();
    const bool path =
        verified_path_found(problem, "Lattice", 3000) || verified_path_found(problem, "RRT", 1500);
    rows.add(key, {static_cast<double>(certified), static_cast<double>(path)});
  }
  int certified = 0, paths = 0, both = 0;
  for (const CampaignRows::Row& row : rows.all()) {
    certified += row.second[0] > 0;
    paths += row.second[1] > 0;
    both += row.second[0] > 0 && row.second[1] > 0;
  }
  const auto maps = static_cast<int>(rows.all().size());
  fmt::print("{} maps: certified {}, verified path {}, neither {}\n", maps, certified, paths,
             maps - certified - paths + both);
  fmt::print("certified, yet with a verified path: {}\n", share_text(both, maps));
}

void coverage(const Settings& settings) {
  constexpr int kDraws = 10000;
  constexpr double kProbability = 0.95;
  CampaignRows rows(settings.out / "coverage.csv", {"kept", "draws"});
  for (const auto& [name, scenario] : feasible_scenarios(settings)) {
    for (int seed = 1; seed <= settings.seeds; ++seed) {
      const std::string key = fmt::format("{}:{}", name, seed);
      if (rows.has(key)) continue;
      PlanningProblem problem = scenario.problem;
      problem.limits.probability_min = kProbability;
      problem.search.seed = static_cast<std::uint64_t>(seed);
      problem.search.time_s = settings.time_s;
      problem.search.candidates = 1;
      const PlanResult result = plan(problem, [](const PlanProgress&) {}, {});
      double kept = 0, draws = 0;
      if (!result.candidates.empty()) {
        const World verdict(problem, WorldUse::kVerdict, 2);
        const Replay path =
            replay(verdict, result.candidates.front().controls, verification_steps(verdict));
        // Draws that the plan has not seen.
        constexpr std::uint64_t kOther = 1000000007;
        draws = kDraws;
        kept =
            std::round(kDraws * margin_spread(problem, path, kDraws, kOther + problem.search.seed,
                                              problem.search.threads)
                                    .probability_feasible);
      }
      rows.add(key, {kept, draws});
    }
  }
  int accepted = 0, held = 0;
  for (const CampaignRows::Row& row : rows.all()) {
    if (row.second[1] == 0) continue;
    fmt::print("{:>20}: {}\n", row.first,
               share_text(static_cast<int>(row.second[0]), static_cast<int>(row.second[1])));
    ++accepted;
    held += row.second[0] >= kProbability * row.second[1];
  }
  fmt::print("accepted paths that keep their margin in {} of {} draws: {}\n", kProbability * kDraws,
             kDraws, share_text(held, accepted));
}

}  // namespace
}  // namespace regoplan

int main(int argc, char** argv) {
  using namespace regoplan;
  CLI::App app("What the planner reaches over many seeds and maps.");
  app.require_subcommand(1);
  Settings settings;
  const std::map<std::string, void (*)(const Settings&)> campaigns{{"first_path", first_path},
                                                                   {"cost", cost},
                                                                   {"certificates", certificates},
                                                                   {"coverage", coverage}};
  for (const auto& [name, campaign] : campaigns) {
    CLI::App* parser = app.add_subcommand(name, "");
    parser->add_option("--out", settings.out, "folder for NAME.csv")->required();
    parser->add_option("--scenarios", settings.scenarios, "folder of scenarios");
    parser->add_option("--scenario", settings.names, "only these, by name");
    parser->add_option("--seeds", settings.seeds, "how many, of each; of maps for certificates");
    parser->add_option("--time", settings.time_s, "seconds of each run");
    parser->callback([&settings, run = campaign] {
      std::filesystem::create_directories(settings.out);
      run(settings);
    });
  }
  CLI11_PARSE(app, argc, argv);
  return 0;
}
