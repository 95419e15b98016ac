#include "planner/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>

#include "planner/candidate.h"
#include "planner/rejection_text.h"
#include "planner/relaxation.h"
#include "planner/relaxed_problem.h"
#include "planner/search_processes.h"
#include "planner/soil_uncertainty.h"
#include "planner/what_if.h"

namespace regoplan {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Hands out runs: planner and seed by the run's number; under a time bound each gets a share of
/// it, under an iteration bound there are a set number of them.
class RunSchedule {
 public:
  RunSchedule(const PlanningProblem& problem, Clock::time_point start)
      : search_(problem.search), margin_min_(problem.limits.margin_min), start_(start) {}

  std::optional<SearchRun> next(int found) {
    const int wanted = kRunsPerCandidate * search_.candidates;
    SearchRun run{.planner = planner_of(number_),
                  .guidance = {.seed = seed_of(number_),
                               .margin_min = margin_min_ + reserve_of(number_),
                               .variety = variety_of(number_)}};
    if (search_.iterations) {
      if (number_ >= wanted) return std::nullopt;
      run.iterations = search_.iterations;
    } else {
      const double left = *search_.time_s - seconds_since(start_);
      constexpr double kTooShort_s = 0.05;
      if (found >= wanted || left < kTooShort_s) return std::nullopt;
      const double share = *search_.time_s * search_.threads / wanted;
      run.time_s = std::min(left, std::max(2 * share, kTooShort_s));
    }
    ++number_;
    return run;
  }
  double progress(int found) const {
    const double wanted = kRunsPerCandidate * search_.candidates;
    const double by_runs = search_.iterations ? number_ / wanted : found / wanted;
    const double by_time = search_.time_s ? seconds_since(start_) / *search_.time_s : 0;
    return std::min(1.0, std::max(by_runs, by_time));
  }

 private:
  /// More paths than candidates, so that there is a choice.
  static constexpr int kRunsPerCandidate = 3;

  std::string planner_of(int number) const {
    if (search_.planner != "auto") return search_.planner;
    // The lattice is by far the fastest, and each way of its own makes another path of it. The
    // trees fill in where it does not reach.
    static const std::vector<std::string> kPortfolio{
        "Lattice", "Lattice", "StableSparse", "Lattice", "Lattice",   "RRT",
        "Lattice", "Lattice", "StableSparse", "Lattice", "SyclopRRT", "KPIECE1"};
    return kPortfolio[static_cast<std::size_t>(number) % kPortfolio.size()];
  }
  std::uint64_t seed_of(int number) const {
    return search_.seed * 1000003 + static_cast<std::uint64_t>(number);
  }

  /// Margin to spare. Some runs ask for a lot, so that there are calm paths to choose from; some
  /// for hardly any, so that a way through a narrow place is found.
  static double reserve_of(int number) {
    static const std::vector<double> kReserves{0.10, 0.01, 0.15, 0.05, 0.03};
    return kReserves[static_cast<std::size_t>(number) % kReserves.size()];
  }

  /// Ways that differ: the first run follows the cheapest, others what chance makes cheapest.
  static double variety_of(int number) {
    constexpr double kMost = 3;
    return number == 0 ? 0 : kMost * (1 + number % 2) / 2;
  }

  const Search& search_;
  double margin_min_;
  Clock::time_point start_;
  int number_ = 0;
};

/// Why nothing may be planned from here, where the start itself may not be.
std::optional<std::string> start_certificate(const World& verdict) {
  const auto rejection = verdict.rejected(verdict.start(), {});
  if (!rejection) return std::nullopt;
  return "the vehicle may not stand at its start: " + rejection_text(*rejection);
}

std::string reason_of(const PlanResult& result, int found) {
  if (result.status == PlanStatus::kFeasible) {
    return fmt::format("{} verified {}", result.candidates.size(),
                       result.candidates.size() == 1 ? "path" : "different paths");
  }
  if (found > 0 && result.overturned.empty()) return fmt::format("{} paths were found", found);
  if (found > 0) {
    return fmt::format("{} paths were found, none passed its verification: {}", found,
                       result.overturned.front().verified.reason);
  }
  const auto most = std::max_element(result.rejected.begin(), result.rejected.end());
  if (*most == 0) return "no path was found in the time given";
  return fmt::format("no path was found in the time given; most states were rejected for {}",
                     name(static_cast<Rejection>(most - result.rejected.begin())));
}

/// Takes away what does not keep the chance constraint. \returns how many
std::size_t drop_improbable(const PlanningProblem& problem, std::vector<VerifiedPath>& paths) {
  const int draws = problem.search.soil_draws;
  return std::erase_if(paths, [&](const VerifiedPath& path) {
    // Not drawn, because of an interrupt: nothing is known against it, and nothing for it.
    if (std::isnan(path.candidate.probability_feasible)) return problem.limits.probability_min > 0;
    const auto successes =
        static_cast<int>(std::lround(path.candidate.probability_feasible * draws));
    return probability_of(successes, draws).low < problem.limits.probability_min;
  });
}

/// Why there is no path, and what to give up for one.
std::string with_relaxation(const std::string& reason, const PlanningProblem& problem,
                            const std::function<void(const PlanProgress&)>& on_progress,
                            const std::stop_token& stop) {
  on_progress({.stage = "looking for what would help"});
  const std::optional<std::string> relaxation = relaxation_that_helps(problem, stop);
  return relaxation ? fmt::format("{}; a verified path exists {}", reason, *relaxation) : reason;
}

}  // namespace

PlanResult plan(const PlanningProblem& problem,
                const std::function<void(const PlanProgress&)>& on_progress,
                const std::stop_token& stop) {
  validate(problem);
  PlanResult result;
  result.seed = problem.search.seed;
  const World verdict(problem, WorldUse::kVerdict, problem.search.threads);
  result.certificate = start_certificate(verdict);
  const bool can_stand = !result.certificate;
  if (can_stand) result.certificate = certificate_of_infeasibility(problem);
  if (result.certificate) {
    result.status = PlanStatus::kInfeasible;
    // The refusal of a start says itself what would have to give way.
    result.reason = can_stand ? with_relaxation(*result.certificate, problem, on_progress, stop)
                              : *result.certificate;
    result.interrupted = stop.stop_requested();
    return result;
  }

  on_progress({.stage = "preparing"});
  const Clock::time_point search_start = Clock::now();
  const World world(problem, WorldUse::kSearch, problem.search.threads);
  RunSchedule schedule(problem, search_start);
  std::vector<FoundPath> found;
  const auto report = [&] {
    const auto count = static_cast<int>(found.size());
    on_progress({.stage = "searching", .share = schedule.progress(count), .found = count});
  };
  search_in_processes(
      world, problem.search.threads,
      [&] {
        report();
        return schedule.next(static_cast<int>(found.size()));
      },
      [&](const SearchRun& run, const std::optional<SearchOutcome>& outcome) {
        if (!outcome) return;
        for (std::size_t i = 0; i < outcome->rejected.size(); ++i) {
          result.rejected[i] += outcome->rejected[i];
        }
        result.rejected_states.insert(result.rejected_states.end(),
                                      outcome->rejected_states.begin(),
                                      outcome->rejected_states.end());
        result.propagations += outcome->propagations;
        if (!outcome->controls.empty()) {
          found.push_back(
              {.planner = run.planner, .seed = run.guidance.seed, .controls = outcome->controls});
        }
        report();
      },
      stop);
  result.planning_time_s = seconds_since(search_start);
  result.interrupted = stop.stop_requested();

  const Clock::time_point verification_start = Clock::now();
  VerifiedPaths verified = verify_all(verdict, world, found, on_progress);
  result.overturned = std::move(verified.overturned);
  std::vector<VerifiedPath> chosen = different_paths(verified.passed, problem.search.candidates);
  if (problem.search.improve && !stop.stop_requested()) {
    on_progress({.stage = "improving", .found = static_cast<int>(chosen.size())});
    // The improved stand first among equals; the others fill in where they differ.
    std::vector<VerifiedPath> all = improved_paths(verdict, world, chosen);
    std::move(verified.passed.begin(), verified.passed.end(), std::back_inserter(all));
    chosen = different_paths(std::move(all), problem.search.candidates);
  }
  for (std::size_t i = 0; i < chosen.size() && !stop.stop_requested(); ++i) {
    on_progress({.stage = "drawing soils",
                 .share = static_cast<double>(i) / static_cast<double>(chosen.size()),
                 .found = static_cast<int>(chosen.size())});
    add_spread(problem, chosen[i]);
  }
  const std::size_t left_out = drop_improbable(problem, chosen);
  rank(chosen);
  if (!chosen.empty()) {
    result.what_ifs = what_ifs(verdict, chosen.front().replay, chosen.front().candidate.controls);
  }
  for (VerifiedPath& path : chosen) result.candidates.push_back(std::move(path.candidate));
  result.verification_time_s = seconds_since(verification_start);
  result.status = result.candidates.empty() ? PlanStatus::kUndecided : PlanStatus::kFeasible;
  result.reason = reason_of(result, static_cast<int>(found.size()));
  if (left_out > 0) {
    result.reason += fmt::format("; {} verified, but not with probability {:.4g} over the soils",
                                 left_out, problem.limits.probability_min);
  }
  if (result.candidates.empty()) {
    result.reason = with_relaxation(result.reason, problem, on_progress, stop);
  }
  result.interrupted = result.interrupted || stop.stop_requested();
  return result;
}

}  // namespace regoplan
