#include <fmt/format.h>
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <numbers>
#include <random>

#include "benchmarks/planner/campaign_rows.h"
#include "benchmarks/planner/campaign_runs.h"
#include "benchmarks/planner/campaign_text.h"
#include "benchmarks/planner/campaigns.h"
#include "terramech/basics/input_error.h"

namespace regoplan {

namespace {

using Clock = std::chrono::steady_clock;

/// The same map, with a start and a goal 500 m ahead of it that the vehicle may stand at.
PlanningProblem drawn_pair(PlanningProblem problem, int seed) {
  constexpr double kAway_m = 500;
  const GridFrame& frame = problem.map.elevation().frame;
  std::mt19937_64 random(static_cast<std::uint64_t>(seed));
  std::uniform_real_distribution<double> unit(0, 1);
  while (true) {
    problem.start.x_m = std::lerp(frame.west_m, frame.east_m(), unit(random));
    problem.start.y_m = std::lerp(frame.south_m(), frame.north_m, unit(random));
    problem.start.heading_rad = std::numbers::pi * (2 * unit(random) - 1);
    problem.goal.x_m = problem.start.x_m + kAway_m * std::cos(problem.start.heading_rad);
    problem.goal.y_m = problem.start.y_m + kAway_m * std::sin(problem.start.heading_rad);
    try {
      validate(problem);
      return problem;
    } catch (const InputError&) {
      // off the map, or a rock: another pair
    }
  }
}

}  // namespace

void large_map_campaign(const CampaignSettings& settings) {
  CampaignRows rows(settings.out / "large_map.csv",
                    {"load_s", "world_s", "search_s", "found", "passed", "verification_s"});
  for (int seed = 1; seed <= settings.seeds; ++seed) {
    const std::string key = fmt::format("{}", seed);
    if (rows.has(key)) continue;
    const Clock::time_point begun = Clock::now();
    const PlanningProblem map = read_scenario(settings.map, {}).problem;
    const double load_s = seconds_since(begun);
    const PlanningProblem problem = drawn_pair(map, seed);
    const Clock::time_point read = Clock::now();
    const World world(problem, WorldUse::kSearch, 2);
    const double world_s = seconds_since(read);
    const TimedOutcome run =
        timed(world, {.planner = "Lattice",
                      .guidance = {.margin_min = problem.limits.margin_min + 0.03},
                      .time_s = settings.time_s,
                      .iterations = {}});
    const bool found = run.outcome && !run.outcome->controls.empty();
    const World verdict(problem, WorldUse::kVerdict, 2);
    const Clock::time_point searched = Clock::now();
    const bool passed = found && passes(verdict, world, run.outcome->controls);
    rows.add(key, {load_s, world_s, run.time_s, static_cast<double>(found),
                   static_cast<double>(passed), seconds_since(searched)});
  }
  std::vector<double> load_s, world_s, search_s, whole_s, verification_s;
  int found = 0, passed = 0;
  for (const CampaignRows::Row& row : rows.all()) {
    load_s.push_back(row.second[0]);
    world_s.push_back(row.second[1]);
    search_s.push_back(row.second[2]);
    whole_s.push_back(row.second[0] + row.second[1] + row.second[2]);
    verification_s.push_back(row.second[5]);
    found += row.second[3] > 0;
    passed += row.second[4] > 0;
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  constexpr double kKibibytesPerMegabyte = 1e6 / 1024;
  fmt::print("load {}\ntables and world {}\nfirst path {}\nall three {}\nverification {}\n",
             times_text(load_s), times_text(world_s), times_text(search_s), times_text(whole_s),
             times_text(verification_s));
  fmt::print("found {}; passed {}; peak memory {:.0f} MB\n",
             share_text(found, static_cast<int>(rows.all().size())), share_text(passed, found),
             static_cast<double>(usage.ru_maxrss) / kKibibytesPerMegabyte);
}

}  // namespace regoplan
