#include "planner/certificate/undecided.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <vector>

#include "planner/certificate/least_length.h"
#include "planner/problem/rejection_text.h"

namespace regoplan {
namespace {

/// A round time: some times what there was, beside what went before the search.
double more_time_s(double time_s, const std::vector<TimedStep>& before_search) {
  constexpr double kTimes = 2.5;
  double least_s = kTimes * time_s;
  for (const TimedStep& step : before_search) least_s += step.time_s;
  const double decade = std::pow(10, std::floor(std::log10(least_s)));
  for (const double round : {1.0, 2.0, 5.0}) {
    if (round * decade >= least_s) return round * decade;
  }
  return 10 * decade;
}

/// The limit that the scenario sets to what a reason counts; nothing where it sets none.
std::optional<double> asked_limit(const PlanningProblem& problem, Rejection reason) {
  const Limits& limits = problem.limits;
  switch (reason) {
    case Rejection::kSpeed:
      return problem.speed_max_mps;
    case Rejection::kSlope:
      return limits.slope_max_rad;
    case Rejection::kSinkage:
      return limits.sinkage_max_m;
    case Rejection::kSlip:
      return limits.slip_max;
    case Rejection::kSlipAngle:
      return limits.slip_angle_max_rad;
    default:
      return is_margin(reason) ? std::optional(limits.margin_min) : std::nullopt;
  }
}

/// What a search asked beyond the scenario's limit; empty where it asked no more.
std::string reserve_words(const PlanningProblem& problem, const RejectedState& state) {
  const std::optional<double> asked = asked_limit(problem, state.reason);
  if (!asked || !state.exceeded) return "";
  const RejectedQuantity& counted = quantity(state.reason);
  const double reserve =
      counted.at_least ? state.exceeded->limit - *asked : *asked - state.exceeded->limit;
  constexpr double kRounding = 1e-9;
  if (reserve <= kRounding) return "";
  return fmt::format("; this search kept a reserve, the scenario {} {:.4g}{}{}",
                     counted.at_least ? "asks" : "allows", *asked / counted.si_per_shown,
                     counted.unit.empty() ? "" : " ", counted.unit);
}

/// How much what is over of a limit is of it.
double missed_by(const RejectedState& state) {
  if (!state.exceeded) return std::numeric_limits<double>::max();
  const auto [found, limit] = *state.exceeded;
  return std::abs(found - limit) / std::max(std::abs(limit), 0.1);
}

/// What refused by far the most states, where that is something else than a reason that refused
/// few; else empty.
std::string mostly_refused_by(const PlanResult& result, Rejection reason) {
  const auto most = std::ranges::max_element(result.rejected);
  constexpr std::int64_t kRare = 10;
  if (*most <= kRare * result.rejected[static_cast<std::size_t>(reason)]) return "";
  const auto usual = static_cast<Rejection>(most - result.rejected.begin());
  const RejectedState* shown = nullptr;
  for (const RejectedState& state : result.rejected_states) {
    if (state.reason != usual) continue;
    if (!shown || missed_by(state) < missed_by(*shown)) shown = &state;
  }
  const auto all = std::accumulate(result.rejected.begin(), result.rejected.end(), std::int64_t{0});
  return fmt::format("; most often, in {} of {} refusals, it was stopped by {}", *most, all,
                     rejection_text(usual, shown ? shown->exceeded : std::nullopt));
}

/// The rejected state that stands for those nearest to the goal: of their most frequent reason, the
/// one that missed its limit by the smallest share.
std::string narrowest_place(const PlanningProblem& problem, const PlanResult& result) {
  const std::vector<RejectedState>& rejected = result.rejected_states;
  const LeastLength way(problem);
  constexpr double kNear = 1.1, kNear_m = 2;
  std::vector<double> left_m;
  for (const RejectedState& state : rejected) {
    const bool inside = problem.map.inside(state.x_m, state.y_m);
    left_m.push_back(inside ? way.to_goal_m(state.x_m, state.y_m)
                            : std::numeric_limits<double>::infinity());
  }
  const double nearest_m = *std::min_element(left_m.begin(), left_m.end());
  if (!std::isfinite(nearest_m)) return "";
  const auto near = [&](std::size_t i) { return left_m[i] <= kNear * nearest_m + kNear_m; };
  // Of each reason about as many are kept, however many there were.
  std::array<double, kRejectionCount> kept{}, kept_near{}, were_near{};
  for (std::size_t i = 0; i < rejected.size(); ++i) {
    const auto reason = static_cast<std::size_t>(rejected[i].reason);
    ++kept.at(reason);
    if (near(i)) ++kept_near.at(reason);
  }
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const double were = std::max(kept[k], static_cast<double>(result.rejected[k]));
    if (kept[k] > 0) were_near[k] = were * kept_near[k] / kept[k];
  }
  const auto reason =
      static_cast<Rejection>(std::ranges::max_element(were_near) - were_near.begin());
  std::size_t best = rejected.size();
  for (std::size_t i = 0; i < rejected.size(); ++i) {
    if (!near(i) || rejected[i].reason != reason) continue;
    if (best == rejected.size() || missed_by(rejected[i]) < missed_by(rejected[best])) best = i;
  }
  return fmt::format("nearest to the goal, with at least {:.0f} m to go, it was stopped by {}{}{}",
                     left_m[best], rejection_text(rejected[best]),
                     reserve_words(problem, rejected[best]), mostly_refused_by(result, reason));
}

}  // namespace

std::string why_undecided(const PlanningProblem& problem, const PlanResult& result,
                          const SearchEnd& end) {
  std::string time;
  const bool used_up = !end.interrupted && (end.cut_short || end.unverified > 0);
  if (problem.search.time_s && used_up) {
    time = fmt::format("{:.4g} s did not suffice, give it {:.4g} s", *problem.search.time_s,
                       more_time_s(*problem.search.time_s, result.before_search));
  }
  const std::string found =
      fmt::format("{} {}", end.found, end.found == 1 ? "path was" : "paths were");
  std::string text;
  if (!result.overturned.empty()) {
    text = fmt::format("{} found, none passed its verification: {}", found,
                       result.overturned.front().verified.reason);
  } else if (end.found > 0) {
    text = found + " found and not yet verified";
  } else {
    text = "no path was found";
    const std::string place =
        result.rejected_states.empty() ? "" : narrowest_place(problem, result);
    if (!place.empty()) text += "; " + place;
  }
  return time.empty() ? text : time + ": " + text;
}

}  // namespace regoplan
