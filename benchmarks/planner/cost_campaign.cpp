#include <fmt/format.h>

#include <array>
#include <cmath>

#include "benchmarks/planner/campaign_rows.h"
#include "benchmarks/planner/campaign_runs.h"
#include "benchmarks/planner/campaign_text.h"
#include "benchmarks/planner/campaigns.h"

namespace regoplan {

namespace {

double duration_s(const SearchOutcome& outcome) {
  double sum = 0;
  for (const ControlSegment& segment : outcome.controls) sum += segment.duration_s;
  return sum;
}

/// One way of searching that the cost campaign compares.
struct Contender {
  std::string label;
  std::string planner;
  bool improve = true;
};

std::vector<Contender> contenders(const CampaignSettings& settings) {
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
  if (pairs == 0) return;
  fmt::print(
      "first path no dearer than SST's in the end: {}; propagations fewer by a factor of "
      "{:.0f} (median), {:.0f} (least); a hundredfold in {}\n",
      share_text(as_good, pairs), quantile(ratios, 0.5), quantile(ratios, 0),
      share_text(hundredfold, pairs));
}

}  // namespace

void cost_campaign(const CampaignSettings& settings) {
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

}  // namespace regoplan
