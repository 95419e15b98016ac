#include "planner/relaxation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "planner/certificate/relaxed_problem.h"
#include "planner/ompl/search_run.h"
#include "planner/problem/changed_problem.h"
#include "planner/runtime/child_processes.h"
#include "planner/verdict/verified_path.h"
#include "terramech/basics/angles.h"

namespace regoplan {
namespace {

/// What a brief search finds, where that passes its verification. It is no longer than that of the
/// plan itself: else it would find what only patience opens.
std::optional<VerifiedPath> briefly_planned(const PlanningProblem& problem) {
  const World verdict(problem, WorldUse::kVerdict, 1);
  if (verdict.rejected(verdict.start(), {}) || certificate_of_infeasibility(problem))
    return std::nullopt;
  const World searched(problem, WorldUse::kSearch, 1);
  constexpr std::int64_t kBriefly = 8000;
  constexpr double kReserve = 0.01;
  const SearchRun run{
      .planner = "Lattice",
      .guidance = {.margin_min = problem.limits.margin_min + kReserve},
      .time_s = {},
      .iterations = std::min(kBriefly, problem.search.iterations.value_or(kBriefly))};
  const SearchOutcome outcome = search(searched, run);
  if (outcome.controls.empty()) return std::nullopt;
  const FoundPath found{.planner = run.planner, .controls = outcome.controls};
  VerifiedPath path = verify(verdict, searched, found);
  if (!path.candidate.verified.passed) return std::nullopt;
  return path;
}

/// How much each thing is changed.
struct Step {
  double speed_share, margin_share, steeper_rad, goal_share, stronger_std;
};
constexpr Step kSteps[] = {{.speed_share = 0.75,
                            .margin_share = 0.5,
                            .steeper_rad = 2.5 * kDegree,
                            .goal_share = 2,
                            .stronger_std = 1},
                           {.speed_share = 0.5,
                            .margin_share = 0,
                            .steeper_rad = 5 * kDegree,
                            .goal_share = 4,
                            .stronger_std = 2}};

/// Friction so many standard deviations above what is known; nothing where it is known exactly, or
/// would be beyond what a soil can have.
std::optional<PlanningProblem> on_stronger_soils(const PlanningProblem& problem, double stds) {
  std::vector<MapSoil> soils = problem.map.soils();
  bool stronger = false;
  for (MapSoil& soil : soils) {
    const double std_rad = soil.soil.standard_deviation.friction_angle_rad;
    constexpr double kMost_rad = 60 * kDegree;
    if (soil.soil.mean.friction_angle_rad + stds * std_rad > kMost_rad) return std::nullopt;
    soil.soil.mean.friction_angle_rad += stds * std_rad;
    stronger = stronger || std_rad > 0;
  }
  if (!stronger) return std::nullopt;
  return with_soils(problem, std::move(soils));
}

std::vector<Relaxation> relaxations_of(const PlanningProblem& problem, const Step& step) {
  std::vector<Relaxation> relaxations;
  const double slower_mps = step.speed_share * problem.speed_max_mps;
  if (std::max(problem.start.speed_mps, problem.goal.speed_max_mps) <= slower_mps) {
    relaxations.push_back(
        {fmt::format("at {} the speed, {:.4g} m/s",
                     step.speed_share == 0.5 ? "half" : "three quarters of", slower_mps),
         with_speed_max(problem, slower_mps)});
  }
  Limits limits = problem.limits;
  limits.margin_min *= step.margin_share;
  if (problem.limits.margin_min > 0) {
    relaxations.push_back(
        {fmt::format("with margin_min {:.4g}", limits.margin_min), with_limits(problem, limits)});
  }
  limits = problem.limits;
  limits.slope_max_rad += step.steeper_rad;
  constexpr double kSteepest_rad = 60 * kDegree;
  if (limits.slope_max_rad <= kSteepest_rad) {
    relaxations.push_back({fmt::format("with slope_max_deg {:.4g}", limits.slope_max_rad / kDegree),
                           with_limits(problem, limits)});
  }
  const double radius_m = step.goal_share * problem.goal.radius_m;
  const double way_m =
      std::hypot(problem.goal.x_m - problem.start.x_m, problem.goal.y_m - problem.start.y_m);
  if (radius_m < way_m) {
    relaxations.push_back({fmt::format("with a goal of radius_m {:.4g}", radius_m),
                           with_goal_radius(problem, radius_m)});
  }
  if (const auto stronger = on_stronger_soils(problem, step.stronger_std)) {
    relaxations.push_back(
        {fmt::format("if friction_angle_deg of every soil were {} standard "
                     "deviation{} higher",
                     step.stronger_std == 1 ? "one" : "two", step.stronger_std == 1 ? "" : "s"),
         *stronger});
  }
  return relaxations;
}

/// Those of one step, side by side.
std::vector<RelaxedAnswer> answers_of(const std::vector<Relaxation>& relaxations, int threads,
                                      const TimeBudget& budget, const std::stop_token& stop,
                                      const SingleThread& alone) {
  std::vector<RelaxedAnswer> answers;
  std::size_t given = 0;
  run_in_children(
      threads, AnswerOrder::kAsGiven,
      [&]() -> std::optional<ChildTask> {
        if (given == relaxations.size()) return std::nullopt;
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
        if (!answer.bytes) return;
        answers.push_back({.given_up = relaxations[answer.task].words, .opened = {}});
        if (auto path = from_bytes<VerifiedPath>(*answer.bytes))
          answers.back().opened = std::move(path->candidate);
      },
      stop, alone);
  return answers;
}

}  // namespace

std::vector<std::vector<Relaxation>> relaxations_of(const PlanningProblem& problem) {
  std::vector<std::vector<Relaxation>> steps;
  for (const Step& step : kSteps) steps.push_back(relaxations_of(problem, step));
  return steps;
}

std::vector<RelaxedAnswer> relaxed_answers(const PlanningProblem& problem, const TimeBudget& budget,
                                           const std::stop_token& stop, const SingleThread& alone) {
  std::vector<RelaxedAnswer> answers;
  for (const std::vector<Relaxation>& step : relaxations_of(problem)) {
    if (stop.stop_requested()) break;
    std::ranges::move(answers_of(step, problem.search.threads, budget, stop, alone),
                      std::back_inserter(answers));
    if (std::ranges::any_of(answers, [](const RelaxedAnswer& a) { return a.opened.has_value(); })) {
      break;
    }
  }
  return answers;
}

}  // namespace regoplan
