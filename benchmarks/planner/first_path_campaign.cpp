#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "benchmarks/planner/campaign_rows.h"
#include "benchmarks/planner/campaign_runs.h"
#include "benchmarks/planner/campaign_text.h"
#include "benchmarks/planner/campaigns.h"

namespace regoplan {

using Clock = std::chrono::steady_clock;

void first_path_campaign(const CampaignSettings& settings) {
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

}  // namespace regoplan
