#include "planner/relaxation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "planner/certificate/relaxed_problem.h"
#include "planner/ompl/search_run.h"
#include "planner/runtime/child_processes.h"
#include "planner/verdict/verified_path.h"
#include "terramech/basics/angles.h"

namespace regoplan {
namespace {

/// Whether a brief search finds a path, and it passes its verification.
bool opens_the_way(const PlanningProblem& problem) {
  const World verdict(problem, WorldUse::kVerdict, 1);
  if (verdict.rejected(verdict.start(), {}) || certificate_of_infeasibility(problem)) return false;
  const World searched(problem, WorldUse::kSearch, 1);
  constexpr std::int64_t kBriefly = 8000;
  constexpr double kReserve = 0.01;
  const SearchRun run{.planner = "Lattice",
                      .guidance = {.margin_min = problem.limits.margin_min + kReserve},
                      .time_s = {},
                      .iterations = kBriefly};
  const SearchOutcome outcome = search(searched, run);
  if (outcome.controls.empty()) return false;
  const FoundPath found{.planner = run.planner, .controls = outcome.controls};
  return verify(verdict, searched, found).candidate.verified.passed;
}

}  // namespace

std::vector<Relaxation> relaxations_of(const PlanningProblem& problem) {
  std::vector<Relaxation> relaxations;
  PlanningProblem slower = problem;
  slower.speed_max_mps /= 2;
  if (std::max(slower.start.speed_mps, slower.goal.speed_max_mps) <= slower.speed_max_mps) {
    relaxations.push_back(
        {fmt::format("at half the speed, {:.4g} m/s", slower.speed_max_mps), slower});
  }
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

std::optional<std::string> relaxation_that_helps(const PlanningProblem& problem,
                                                 const TimeBudget& budget,
                                                 const std::stop_token& stop,
                                                 const SingleThread& alone) {
  const std::vector<Relaxation> relaxations = relaxations_of(problem);
  std::optional<std::string> helps;
  std::size_t given = 0;
  run_in_children(
      problem.search.threads, AnswerOrder::kAsGiven,
      [&]() -> std::optional<ChildTask> {
        if (helps || given == relaxations.size()) return std::nullopt;
        const double left_s = budget.left_s(TimeBudget::kAnswerShare);
        if (left_s <= 0) return std::nullopt;
        const PlanningProblem& relaxed = relaxations[given++].problem;
        ChildTask task{.work = [&relaxed] {
          return std::vector<char>(1, opens_the_way(relaxed) ? 'y' : 'n');
        }};
        if (std::isfinite(left_s)) task.time_limit_s = left_s;
        return task;
      },
      [&](const ChildAnswer& answer) {
        if (helps || !answer.bytes || answer.bytes->front() != 'y') return;
        helps = relaxations[answer.task].words;
      },
      stop, alone);
  return helps;
}

}  // namespace regoplan
