#include <fmt/format.h>

#include <cmath>

#include "benchmarks/planner/campaign_rows.h"
#include "benchmarks/planner/campaign_runs.h"
#include "benchmarks/planner/campaign_text.h"
#include "benchmarks/planner/campaigns.h"
#include "planner/driving/margin_draws.h"
#include "planner/driving/replay.h"
#include "planner/plan.h"

namespace regoplan {

void coverage_campaign(const CampaignSettings& settings) {
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
      const PlanResult result = plan(problem);
      double kept = 0, draws = 0;
      if (!result.candidates.empty()) {
        const World verdict(problem, WorldUse::kVerdict, 2);
        const Replay path =
            replay(verdict, result.candidates.front().controls, verification_steps(verdict));
        // Draws that the plan has not seen.
        constexpr std::uint64_t kOther = 1000000007;
        draws = kDraws;
        const std::vector<double> smallest = smallest_margins(
            problem, path, {.count = kDraws}, kOther + problem.search.seed, problem.search.threads);
        kept =
            std::round(kDraws * margin_spread(smallest, problem.limits.margin_min).feasible.share);
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

}  // namespace regoplan
