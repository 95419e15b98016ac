// What the planner reaches over many seeds and maps. Each campaign writes a CSV file, a row a run,
// goes on where it was stopped, and ends by printing its summary:
//   planner_campaign first_path   --out DIR [--seeds N] [--verified N] [--scenario NAME]...
//   planner_campaign cost         --out DIR [--seeds N] [--time S] [--planner NAME]...
//   planner_campaign certificates --out DIR [--seeds N]
//   planner_campaign coverage     --out DIR [--seeds N] [--scenario NAME]...
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
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
  std::vector<std::string> planners{"Lattice", "SST", "RRT", "KPIECE1"};
  int seeds = 10;
  int verified = 1 << 30;
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

std::string times_text(const std::vector<double>& times_s) {
  return fmt::format("{:.3f} s (p90 {:.3f}, most {:.3f})", quantile(times_s, 0.5),
                     quantile(times_s, 0.9), quantile(times_s, 1));
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

bool passes(const World& verdict, const World& searched,
            const std::vector<ControlSegment>& controls) {
  return !verify_all(verdict, searched, {{.planner = {}, .controls = controls}},
                     [](const PlanProgress&) {})
              .passed.empty();
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
                    {"found", "search_s", "process_s", "propagations", "passed", "verification_s"});
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
      // Nothing is said of the others.
      const double passed = seed > settings.verified
                                ? std::nan("")
                                : (found && passes(verdict, world, run.outcome->controls) ? 1 : 0);
      rows.add(key, {static_cast<double>(found), run.outcome ? run.outcome->time_s : run.time_s,
                     run.time_s, run.outcome ? static_cast<double>(run.outcome->propagations) : 0,
                     passed, seconds_since(start)});
    }
  }
  std::map<std::string, std::vector<const CampaignRows::Row*>> by_scenario;
  for (const CampaignRows::Row& row : rows.all()) {
    by_scenario[first_part(row.first)].push_back(&row);
    by_scenario["all"].push_back(&row);
  }
  for (const auto& [name, runs] : by_scenario) {
    std::vector<double> search_s, process_s, verification_s;
    int found = 0, verified = 0, overturned = 0;
    for (const CampaignRows::Row* row : runs) {
      search_s.push_back(row->second[1]);
      process_s.push_back(row->second[2]);
      found += row->second[0] > 0;
      if (!(row->second[0] > 0) || std::isnan(row->second[4])) continue;
      verification_s.push_back(row->second[5]);
      ++verified;
      overturned += row->second[4] == 0;
    }
    fmt::print("{:>16}: search {}; with its process {}; found {}", name, times_text(search_s),
               times_text(process_s), share_text(found, static_cast<int>(runs.size())));
    if (verified > 0) {
      fmt::print("; verification {}; overturned {}", times_text(verification_s),
                 share_text(overturned, verified));
    }
    fmt::print("\n");
  }
}

/// One way of searching that the cost campaign compares.
struct Contender {
  std::string label;
  std::string planner;
  bool improve = true;
};

std::vector<Contender> contenders(const Settings& settings) {
  std::vector<Contender> all{{"First", "Lattice", false}};
  for (const std::string& planner : settings.planners) all.push_back({planner, planner});
  return all;
}

/// Runs of each scenario and seed by the contender's label.
using Pairs = std::map<std::string, std::map<std::string, std::vector<double>>>;

void compare(const Pairs& by_run, const std::string& own, const std::string& stock) {
  int better = 0, pairs = 0;
  std::vector<double> ratios;
  std::map<std::string, std::pair<int, int>> by_scenario;
  for (const auto& [run, rows] : by_run) {
    if (!rows.contains(own) || !rows.contains(stock)) continue;
    const double cost = rows.at(own)[0], other = rows.at(stock)[0];
    auto& [won, of] = by_scenario[first_part(run)];
    ++pairs, ++of;
    if (cost < other) ++better, ++won;
    if (std::isfinite(other)) ratios.push_back(cost / other);
  }
  if (pairs == 0) return;
  fmt::print("{:>12} cheaper than {:>7} in {}; median ratio {:.3f}, largest {:.3f}\n", own, stock,
             share_text(better, pairs), quantile(ratios, 0.5), quantile(ratios, 1));
  for (const auto& [name, share] : by_scenario) {
    if (share.first < share.second)
      fmt::print("{:>24}: {} of {}\n", name, share.first, share.second);
  }
}

/// Where the first path of the lattice costs no more than what SST has after all its time: how
/// many times fewer propagations it took.
void compare_propagations(const Pairs& by_run) {
  int as_good = 0, hundredfold = 0, pairs = 0;
  std::vector<double> ratios;
  for (const auto& [run, rows] : by_run) {
    if (!rows.contains("First") || !rows.contains("SST")) continue;
    const std::vector<double>&first = rows.at("First"), &sst = rows.at("SST");
    ++pairs;
    if (!(first[0] <= sst[0]) || !std::isfinite(first[0])) continue;
    ++as_good;
    ratios.push_back(sst[1] / first[1]);
    hundredfold += ratios.back() >= 100;
  }
  fmt::print(
      "first path no dearer than SST's in the end: {}; propagations fewer by a factor of "
      "{:.0f} (median), {:.0f} (least); a hundredfold in {}\n",
      share_text(as_good, pairs), quantile(ratios, 0.5), quantile(ratios, 0),
      share_text(hundredfold, pairs));
}

void cost(const Settings& settings) {
  CampaignRows rows(settings.out / "cost.csv", {"cost", "propagations", "search_s", "passed"});
  for (int seed = 1; seed <= settings.seeds; ++seed) {
    for (const auto& [name, scenario] : feasible_scenarios(settings)) {
      const PlanningProblem& problem = scenario.problem;
      const World world(problem, WorldUse::kSearch, 2), verdict(problem, WorldUse::kVerdict, 2);
      for (const Contender& contender : contenders(settings)) {
        const std::string key = fmt::format("{}:{}:{}", name, seed, contender.label);
        if (rows.has(key)) continue;
        const TimedOutcome run =
            timed(world, {.planner = contender.planner,
                          .guidance = {.seed = static_cast<std::uint64_t>(seed),
                                       .margin_min = problem.limits.margin_min + 0.03,
                                       .improve = contender.improve},
                          .time_s = settings.time_s,
                          .iterations = {}});
        const SearchOutcome outcome = run.outcome.value_or(SearchOutcome{});
        const bool found = !outcome.controls.empty();
        rows.add(key, {found ? duration_s(outcome) : INFINITY,
                       static_cast<double>(outcome.propagations), outcome.time_s,
                       static_cast<double>(found && passes(verdict, world, outcome.controls))});
      }
    }
  }
  Pairs by_run;
  std::map<std::string, std::array<int, 3>> by_label;  // runs, found, passed
  for (const CampaignRows::Row& row : rows.all()) {
    by_run[row.first.substr(0, row.first.rfind(':'))][last_part(row.first)] = row.second;
    auto& [runs, found, passed] = by_label[last_part(row.first)];
    ++runs;
    found += std::isfinite(row.second[0]);
    passed += row.second[3] > 0;
  }
  for (const auto& [label, counts] : by_label) {
    fmt::print("{:>12}: found {}; of these passed {}\n", label, share_text(counts[1], counts[0]),
               share_text(counts[2], counts[1]));
  }
  for (const char* own : {"First", "Lattice", "StableSparse", "StateCost"}) {
    for (const char* stock : {"SST", "RRT", "KPIECE1"}) compare(by_run, own, stock);
  }
  compare_propagations(by_run);
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
      problem.search.soil_draws = 1000;  // of 100, 99 that hold show .946
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
    parser->add_option("--planner", settings.planners, "of the cost campaign");
    parser->add_option("--seeds", settings.seeds, "how many, of each; of maps for certificates");
    parser->add_option("--verified", settings.verified, "seeds of first_path to verify too");
    parser->add_option("--time", settings.time_s, "seconds of each run");
    parser->callback([&settings, run = campaign] {
      std::filesystem::create_directories(settings.out);
      run(settings);
    });
  }
  CLI11_PARSE(app, argc, argv);
  return 0;
}
