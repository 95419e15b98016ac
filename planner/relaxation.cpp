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

/// What a brief search finds, where that passes its verification.
std::optional<VerifiedPath> briefly_planned(const PlanningProblem& problem) {
  const World verdict(problem, WorldUse::kVerdict, 1);
  if (verdict.rejected(verdict.start(), {}) || certificate_of_infeasibility(problem))
    return std::nullopt;
  const World searched(problem, WorldUse::kSearch, 1);
  constexpr std::int64_t kBriefly = 8000;
  constexpr double kReserve = 0.01;
  const SearchRun run{.planner = "Lattice",
                      .guidance = {.margin_min = problem.limits.margin_min + kReserve},
                      .time_s = {},
                      .iterations = kBriefly};
  const SearchOutcome outcome = search(searched, run);
  if (outcome.controls.empty()) return std::nullopt;
  const FoundPath found{.planner = run.planner, .controls = outcome.controls};
  VerifiedPath path = verify(verdict, searched, found);
  if (!path.candidate.verified.passed) return std::nullopt;
  return path;
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

std::vector<RelaxedAnswer> relaxed_answers(const PlanningProblem& problem, const TimeBudget& budget,
                                           const std::stop_token& stop, const SingleThread& alone) {
  const std::vector<Relaxation> relaxations = relaxations_of(problem);
  std::vector<RelaxedAnswer> answers;
  const auto opened = [&answers] { return !answers.empty() && answers.back().opened; };
  std::size_t given = 0;
  run_in_children(
      problem.search.threads, AnswerOrder::kAsGiven,
      [&]() -> std::optional<ChildTask> {
        if (opened() || given == relaxations.size()) return std::nullopt;
        const double left_s = budget.left_s(TimeBudget::kAnswerShare);
        if (left_s <= 0) return std::nullopt;
        const PlanningProblem& relaxed = relaxations[given++].problem;
        ChildTask task{.work = [&relaxed] {
          const std::optional<VerifiedPath> path = briefly_planned(relaxed);
          return path ? bytes_of(*path) : std::vector<char>();
        }};
        if (std::isfinite(left_s)) task.time_limit_s = left_s;
        return task;
      },
      [&](const ChildAnswer& answer) {
        if (opened() || !answer.bytes) return;
        answers.push_back({.given_up = relaxations[answer.task].words, .opened = {}});
        if (auto path = from_bytes<VerifiedPath>(*answer.bytes))
          answers.back().opened = std::move(path->candidate);
      },
      stop, alone);
  return answers;
}

}  // namespace regoplan
