#include "planner/relaxation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

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
/// \param verdict the world of the relaxed problem
std::optional<VerifiedPath> briefly_planned(const World& verdict) {
  const PlanningProblem& problem = verdict.problem();
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

/// What a search of a relaxed problem found, as its process tells it.
struct RelaxedPath {
  VerifiedPath path;
  bool within_limits = false;  ///< it passes for the problem as it was asked, and is judged by that
};

template <class Archive, FieldsOf<RelaxedPath> Path>
void each_field(Archive& archive, Path& path) {
  each_field(archive, path.path);
  archive(path.within_limits);
}

std::optional<RelaxedPath> relaxed_path(const PlanningProblem& relaxed, const World* asked) {
  const World verdict(relaxed, WorldUse::kVerdict, 1);
  std::optional<VerifiedPath> opened = briefly_planned(verdict);
  if (!opened) return std::nullopt;
  if (asked) {
    VerifiedPath within = verified_in(*asked, verification_steps(verdict), *opened);
    if (within.candidate.verified.passed) return RelaxedPath{std::move(within), true};
  }
  return RelaxedPath{std::move(*opened), false};
}

/// Takes what one of the relaxations came to.
void take(std::optional<RelaxedPath> found, RelaxedAnswer& answer, RelaxedSearch& search) {
  if (!found) return;
  Candidate& candidate = found->path.candidate;
  if (!found->within_limits) {
    answer.opened = std::move(candidate);
  } else if (!search.within_limits ||
             candidate.duration_s < search.within_limits->candidate.duration_s) {
    search.within_limits = std::move(found->path);
  }
}

/// Those of one step, side by side.
RelaxedSearch step_search(const std::vector<Relaxation>& relaxations, const World* asked,
                          int threads, const TimeBudget& budget, const std::stop_token& stop,
                          const SingleThread& alone) {
  RelaxedSearch search;
  std::size_t given = 0;
  run_in_children(
      threads, AnswerOrder::kAsGiven,
      [&]() -> std::optional<ChildTask> {
        if (given == relaxations.size()) return std::nullopt;
        const double left_s = budget.left_s(TimeBudget::kAnswerShare);
        if (left_s <= 0) return std::nullopt;
        const PlanningProblem& relaxed = relaxations[given++].problem;
        ChildTask task{.work = [&relaxed, asked] {
          const std::optional<RelaxedPath> path = relaxed_path(relaxed, asked);
          return path ? bytes_of(*path) : std::vector<char>();
        }};
        if (std::isfinite(left_s)) task.time_limit_s = left_s;
        return task;
      },
      [&](const ChildAnswer& answer) {
        if (!answer.bytes) return;
        search.answers.push_back({.given_up = relaxations[answer.task].words, .opened = {}});
        take(from_bytes<RelaxedPath>(*answer.bytes), search.answers.back(), search);
      },
      stop, alone);
  return search;
}

}  // namespace

std::vector<std::vector<Relaxation>> relaxations_of(const PlanningProblem& problem) {
  std::vector<std::vector<Relaxation>> steps;
  for (const Step& step : kSteps) steps.push_back(relaxations_of(problem, step));
  return steps;
}

RelaxedSearch relaxed_search(const PlanningProblem& problem, const World* asked,
                             const TimeBudget& budget, const std::stop_token& stop,
                             const SingleThread& alone) {
  RelaxedSearch search;
  for (const std::vector<Relaxation>& step : relaxations_of(problem)) {
    if (stop.stop_requested()) break;
    RelaxedSearch found = step_search(step, asked, problem.search.threads, budget, stop, alone);
    std::ranges::move(found.answers, std::back_inserter(search.answers));
    search.within_limits = std::move(found.within_limits);
    const bool opened = std::ranges::any_of(
        search.answers, [](const RelaxedAnswer& a) { return a.opened.has_value(); });
    if (opened || search.within_limits) break;
  }
  return search;
}

}  // namespace regoplan
