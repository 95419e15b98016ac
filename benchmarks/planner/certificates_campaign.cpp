#include <fmt/format.h>

#include "benchmarks/planner/campaign_rows.h"
#include "benchmarks/planner/campaign_text.h"
#include "benchmarks/planner/campaigns.h"
#include "benchmarks/planner/random_problem.h"
#include "planner/certificate/relaxed_problem.h"

namespace regoplan {

void certificates_campaign(const CampaignSettings& settings) {
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

}  // namespace regoplan
