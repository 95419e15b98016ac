#include "planner/relaxation.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <vector>

#include "planner/candidate.h"
#include "planner/relaxed_problem.h"
#include "planner/search_processes.h"

namespace regoplan {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

struct Relaxation {
  std::string words;
  PlanningProblem problem;
};

std::vector<Relaxation> relaxations_of(const PlanningProblem& problem) {
  std::vector<Relaxation> relaxations;
  PlanningProblem slower = problem;
  slower.speed_max_mps /= 2;
  slower.start.speed_mps = std::min(slower.start.speed_mps, slower.speed_max_mps);
  relaxations.push_back(
      {fmt::format("at half the speed, {:.4g} m/s", slower.speed_max_mps), slower});
  if (problem.limits.margin_min > 0) {
    PlanningProblem bolder = problem;
    bolder.limits.margin_min = 0;
    relaxations.push_back({"with margin_min 0", bolder});
  }
  constexpr double kSteeper_rad = 5 * kDegree, kSteepest_rad = 60 * kDegree;
  PlanningProblem steeper = problem;
  steeper.limits.slope_max_rad += kSteeper_rad;
  if (steeper.limits.slope_max_rad <= kSteepest_rad) {
    relaxations.push_back(
        {fmt::format("with slope_max_deg {:.4g}", steeper.limits.slope_max_rad / kDegree),
         steeper});
  }
  return relaxations;
}

bool opens_the_way(const PlanningProblem& problem, const std::stop_token& stop) {
  const World verdict(problem, WorldUse::kVerdict, problem.search.threads);
  if (verdict.rejected(verdict.start(), {}) || certificate_of_infeasibility(problem)) return false;
  const World searched(problem, WorldUse::kSearch, problem.search.threads);
  constexpr std::int64_t kBriefly = 8000;
  constexpr double kReserve = 0.01;
  bool given = false;
  std::vector<FoundPath> found;
  search_in_processes(
      searched, 1,
      [&]() -> std::optional<SearchRun> {
        if (given) return std::nullopt;
        given = true;
        return SearchRun{.planner = "Lattice",
                         .guidance = {.margin_min = problem.limits.margin_min + kReserve},
                         .time_s = {},
                         .iterations = kBriefly};
      },
      [&](const SearchRun& run, const std::optional<SearchOutcome>& outcome) {
        if (outcome && !outcome->controls.empty()) {
          found.push_back({.planner = run.planner, .controls = outcome->controls});
        }
      },
      stop);
  return !verify_all(verdict, searched, found, [](const PlanProgress&) {}).passed.empty();
}

}  // namespace

std::optional<std::string> relaxation_that_helps(const PlanningProblem& problem,
                                                 const std::stop_token& stop) {
  for (const Relaxation& relaxation : relaxations_of(problem)) {
    if (stop.stop_requested()) return std::nullopt;
    if (opens_the_way(relaxation.problem, stop)) return relaxation.words;
  }
  return std::nullopt;
}

}  // namespace regoplan
