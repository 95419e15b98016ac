#include "planner/plan.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "planner/certificate/least_duration.h"
#include "planner/certificate/relaxed_problem.h"
#include "planner/certificate/undecided.h"
#include "planner/chart/margin_rasters.h"
#include "planner/driving/crash_ahead.h"
#include "planner/driving/margin_draws.h"
#include "planner/driving/what_if.h"
#include "planner/problem/rejection_text.h"
#include "planner/relaxation.h"
#include "planner/runtime/child_processes.h"
#include "planner/runtime/plain_bytes.h"
#include "planner/runtime/time_budget.h"
#include "planner/search/run_schedule.h"
#include "planner/verdict/ranking.h"
#include "planner/verdict/verified_path.h"

namespace regoplan {
namespace {

// When each stage ends, as shares of the time of the whole answer. A search that has found nothing
// that passes goes on longer; a stage that is done early gives the rest to those that follow.
constexpr double kSearchShare = 0.4, kFirstPathShare = 0.75;
constexpr double kVerifyShare = 0.5, kFirstVerifyShare = 0.85;
constexpr double kImproveShare = 0.75;
constexpr double kDrawsShare = 0.92;

/// Draws of the soils that are judged in one go.
constexpr int kDrawsAtOnce = 10;

/// A piece of work for a process of its own.
struct Piece {
  std::function<std::vector<char>()> work;
  double time_limit_s = 0;                                            ///< infinite: none
  std::function<void(const std::optional<std::vector<char>>&)> take;  ///< nothing: it failed
  std::function<bool()> superfluous{};
};

/// What a run of the search came to, and its path.
struct RunResult {
  SearchRun run;
  std::optional<SearchOutcome> outcome;  ///< nothing where it was killed
  enum { kWaiting, kUnderway, kJudged } state = kWaiting;
  std::optional<VerifiedPath> path;

  bool found() const { return outcome && !outcome->controls.empty(); }
};

double duration_s(const std::vector<ControlSegment>& controls) {
  double sum = 0;
  for (const ControlSegment& segment : controls) sum += segment.duration_s;
  return sum;
}

/// Why nothing may be planned from here, where the start itself may not be.
std::optional<std::string> start_certificate(const World& verdict) {
  const auto rejection = verdict.rejected(verdict.start(), {});
  if (!rejection) return std::nullopt;
  return "the vehicle may not stand at its start: " + rejection_text(*rejection);
}

/// One plan on its way.
class Planning {
 public:
  Planning(const PlanningProblem& problem, const PlanSession& session)
      : problem_(problem),
        session_(session),
        budget_(session.started, problem.search.time_s),
        verdict_(problem, WorldUse::kVerdict, problem.search.threads) {
    result_.seed = problem.search.seed;
  }

  PlanResult run() && {
    result_.certificate = start_certificate(verdict_);
    const bool can_stand = !result_.certificate;
    if (can_stand) result_.certificate = certificate_of_infeasibility(problem_);
    if (result_.certificate) {
      result_.status = PlanStatus::kInfeasible;
      // The refusal of a start says itself what would have to give way.
      result_.reason = can_stand ? with_relaxation(*result_.certificate) : *result_.certificate;
      return answered();
    }
    tell("preparing", 0);
    searched_.emplace(problem_, WorldUse::kSearch, problem_.search.threads);
    const double search_start_s = budget_.elapsed_s();
    search_and_verify();
    result_.planning_time_s = search_end_s_ - search_start_s;
    improve();
    draw_soils();
    result_.verification_time_s = budget_.elapsed_s() - search_end_s_;
    decide();
    return answered();
  }

 private:
  bool timed() const { return problem_.search.time_s.has_value(); }
  bool stopped() const { return session_.stop.stop_requested(); }

  void tell(std::string_view stage, double share) {
    session_.on_progress({.stage = stage, .share = share, .found = found_, .verified = verified_});
  }

  /// Works off pieces in child processes until there are no more.
  void work_off(const std::function<std::optional<Piece>()>& next) {
    std::vector<std::function<void(const std::optional<std::vector<char>>&)>> takers;
    run_in_children(
        problem_.search.threads, AnswerOrder::kAsEnded,
        [&]() -> std::optional<ChildTask> {
          std::optional<Piece> piece = next();
          if (!piece) return std::nullopt;
          takers.push_back(std::move(piece->take));
          ChildTask task{.work = std::move(piece->work),
                         .superfluous = std::move(piece->superfluous)};
          if (std::isfinite(piece->time_limit_s)) task.time_limit_s = piece->time_limit_s;
          return task;
        },
        [&](const ChildAnswer& answer) { takers[answer.task](answer.bytes); }, session_.stop);
  }

  void search_and_verify() {
    RunSchedule schedule(problem_.search, problem_.limits.margin_min);
    search_end_s_ = budget_.elapsed_s();
    work_off([&]() -> std::optional<Piece> {
      const double runs = timed() ? found_ : schedule.given();
      tell("searching", std::min(1.0, runs / schedule.wanted()));
      if (auto piece = verification_of_most_promising()) return piece;
      const double left_s = budget_.left_s(verified_ > 0 ? kSearchShare : kFirstPathShare);
      const auto run = schedule.next(found_, left_s);
      if (!run) return std::nullopt;
      return search_piece(*run, schedule.wanted());
    });
    for (const RunResult& run : runs_) {
      if (!run.outcome) continue;
      for (std::size_t i = 0; i < run.outcome->rejected.size(); ++i) {
        result_.rejected[i] += run.outcome->rejected[i];
      }
      result_.rejected_states.insert(result_.rejected_states.end(),
                                     run.outcome->rejected_states.begin(),
                                     run.outcome->rejected_states.end());
      result_.propagations += run.outcome->propagations;
      if (!run.path) continue;
      if (run.path->candidate.verified.passed) {
        paths_.push_back(*run.path);
      } else {
        result_.overturned.push_back(run.path->candidate);
      }
    }
  }

  Piece search_piece(const SearchRun& run, int wanted) {
    const std::size_t number = runs_.size();
    runs_.push_back({.run = run, .outcome = {}, .path = {}});
    return {.work = [this, run] { return bytes_of(search(*searched_, run)); },
            .time_limit_s = budget_.left_s(kFirstVerifyShare),
            .take =
                [this, number](const std::optional<std::vector<char>>& bytes) {
                  RunResult& result = runs_[number];
                  if (bytes) result.outcome = from_bytes<SearchOutcome>(*bytes);
                  if (result.found()) ++found_;
                  search_end_s_ = budget_.elapsed_s();
                },
            .superfluous = [this, wanted] { return timed() && found_ >= wanted; }};
  }

  /// The shortest of what is found and not judged yet.
  std::optional<Piece> verification_of_most_promising() {
    const double left_s = budget_.left_s(verified_ > 0 ? kVerifyShare : kFirstVerifyShare);
    if (left_s <= 0) return std::nullopt;
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      if (runs_[i].state != RunResult::kWaiting || !runs_[i].found()) continue;
      if (!best ||
          duration_s(runs_[i].outcome->controls) < duration_s(runs_[*best].outcome->controls)) {
        best = i;
      }
    }
    if (!best) return std::nullopt;
    RunResult& result = runs_[*best];
    result.state = RunResult::kUnderway;
    const FoundPath path{.planner = result.run.planner,
                         .seed = result.run.guidance.seed,
                         .controls = result.outcome->controls};
    return Piece{.work = [this, path] { return bytes_of(verify(verdict_, *searched_, path)); },
                 .time_limit_s = budget_.left_s(kFirstVerifyShare),
                 .take =
                     [this, number = *best](const std::optional<std::vector<char>>& bytes) {
                       RunResult& judged = runs_[number];
                       if (bytes) judged.path = from_bytes<VerifiedPath>(*bytes);
                       if (!judged.path) return;
                       judged.state = RunResult::kJudged;
                       if (judged.path->candidate.verified.passed) {
                         announce(judged.path->candidate);
                       }
                     }};
  }

  void announce(const Candidate& candidate) {
    ++verified_;
    const double now_s = budget_.elapsed_s();
    if (!result_.first_verified_s) result_.first_verified_s = now_s;
    session_.on_verified(candidate, now_s);
  }

  void improve() {
    chosen_ = different_paths(paths_, problem_.search.candidates);
    if (!problem_.search.improve) return;
    std::vector<std::optional<VerifiedPath>> better(chosen_.size());
    std::size_t next = 0;
    work_off([&]() -> std::optional<Piece> {
      const double left_s = budget_.left_s(kImproveShare);
      if (next == chosen_.size() || left_s <= 0) return std::nullopt;
      tell("improving", static_cast<double>(next) / static_cast<double>(chosen_.size()));
      const std::size_t i = next++;
      return Piece{.work =
                       [this, i] {
                         const auto path = improved_path(verdict_, *searched_, chosen_[i]);
                         return path ? bytes_of(*path) : std::vector<char>();
                       },
                   .time_limit_s = left_s,
                   .take =
                       [this, &better, i](const std::optional<std::vector<char>>& bytes) {
                         if (!bytes || bytes->empty()) return;
                         better[i] = from_bytes<VerifiedPath>(*bytes);
                         if (better[i]) announce(better[i]->candidate);
                       }};
    });
    // The improved stand first among equals; the others fill in where they differ.
    std::vector<VerifiedPath> all;
    for (std::optional<VerifiedPath>& path : better) {
      if (path) all.push_back(std::move(*path));
    }
    std::move(paths_.begin(), paths_.end(), std::back_inserter(all));
    chosen_ = different_paths(std::move(all), problem_.search.candidates);
  }

  /// Besides the draws, what else the answer needs and nothing waits for.
  void draw_soils() {
    const int draws = problem_.search.soil_draws;
    std::vector<std::map<int, std::vector<double>>> drawn(chosen_.size());
    std::vector<int> given(chosen_.size());
    bool bounded = false, mapped = false, weighed = false;
    work_off([&]() -> std::optional<Piece> {
      if (!std::exchange(bounded, true)) return bound_piece();
      if (!chosen_.empty() && given.front() > 0 && !std::exchange(mapped, true)) {
        return rasters_piece();
      }
      constexpr int kFirst = 20;  // draws of every candidate come first
      if (!given.empty() && *std::ranges::min_element(given) >= kFirst &&
          !std::exchange(weighed, true)) {
        return probability_piece();
      }
      const auto least = std::min_element(given.begin(), given.end());
      const double left_s = budget_.left_s(kDrawsShare);
      if (least == given.end() || *least >= draws || left_s <= 0) return std::nullopt;
      tell("drawing soils", static_cast<double>(*least) / draws);
      const auto i = static_cast<std::size_t>(least - given.begin());
      const DrawRange range{.first = *least, .count = std::min(kDrawsAtOnce, draws - *least)};
      *least += range.count;
      return Piece{.work =
                       [this, i, range] {
                         ByteWriter writer;
                         writer(smallest_margins(problem_, chosen_[i].replay, range,
                                                 problem_.search.seed, 1));
                         return writer.take();
                       },
                   .time_limit_s = budget_.left_s(TimeBudget::kAnswerShare),
                   .take =
                       [&drawn, i, range](const std::optional<std::vector<char>>& bytes) {
                         if (!bytes) return;
                         ByteReader reader(*bytes);
                         reader(drawn[i][range.first]);
                       }};
    });
    if (result_.rasters) result_.rasters->probability = std::move(probability_);
    for (std::size_t i = 0; i < chosen_.size(); ++i) {
      std::vector<double> smallest;
      for (const auto& [first, margins] : drawn[i]) {
        smallest.insert(smallest.end(), margins.begin(), margins.end());
      }
      if (smallest.empty()) continue;
      chosen_[i].candidate.spread = margin_spread(smallest, problem_.limits.margin_min);
    }
  }

  Piece bound_piece() {
    return {.work =
                [this] {
                  ByteWriter writer;
                  writer(least_duration_s(problem_));
                  return writer.take();
                },
            .time_limit_s = budget_.left_s(TimeBudget::kAnswerShare),
            .take =
                [this](const std::optional<std::vector<char>>& bytes) {
                  if (!bytes) return;
                  ByteReader reader(*bytes);
                  reader(result_.least_duration_s.emplace());
                }};
  }

  Piece rasters_piece() {
    return {.work = [this] { return bytes_of(terrain_rasters(problem_)); },
            .time_limit_s = budget_.left_s(TimeBudget::kAnswerShare),
            .take =
                [this](const std::optional<std::vector<char>>& bytes) {
                  if (bytes) result_.rasters = from_bytes<TerrainRasters>(*bytes);
                }};
  }

  Piece probability_piece() {
    return {.work =
                [this] {
                  ByteWriter writer;
                  writer(straight_on_probability(problem_));
                  return writer.take();
                },
            .time_limit_s = budget_.left_s(kDrawsShare),
            .take =
                [this](const std::optional<std::vector<char>>& bytes) {
                  if (!bytes) return;
                  ByteReader reader(*bytes);
                  reader(probability_);
                }};
  }

  /// Takes away what does not keep the chance constraint. \returns how many
  std::size_t drop_improbable() {
    return std::erase_if(chosen_, [&](const VerifiedPath& path) {
      return !probable_enough(path.candidate, problem_.limits);
    });
  }

  void decide() {
    const std::size_t left_out = drop_improbable();
    rank(chosen_);
    for (const VerifiedPath& path : chosen_) result_.candidates.push_back(path.candidate);
    const std::string improbable =
        left_out == 0 ? ""
                      : fmt::format("{} verified, but not with probability {:.4g} over the soils",
                                    left_out, problem_.limits.probability_min);
    if (!chosen_.empty()) {
      result_.status = PlanStatus::kFeasible;
      result_.reason = fmt::format("{} verified {}{}{}", chosen_.size(),
                                   chosen_.size() == 1 ? "path" : "different paths",
                                   improbable.empty() ? "" : "; ", improbable);
      result_.interrupted = stopped();
      session_.on_answer(result_);
      ask_what_if();
    } else {
      const std::string why =
          improbable.empty() ? why_undecided(problem_, result_, search_end()) : improbable;
      const std::optional<std::string> crash = crash_ahead(verdict_);
      result_.reason = with_relaxation(crash ? fmt::format("{}; {}", *crash, why) : why);
    }
  }

  SearchEnd search_end() const {
    SearchEnd end{.found = found_, .cut_short = true};
    for (const RunResult& run : runs_) {
      if (run.found() && run.state != RunResult::kJudged) ++end.unverified;
      constexpr double kShare = 0.98;
      if (run.outcome && run.run.time_s && run.outcome->time_s < kShare * *run.run.time_s) {
        end.cut_short = false;
      }
    }
    return end;
  }

  void ask_what_if() {
    const VerifiedPath& best = chosen_.front();
    std::vector<std::function<WhatIf()>> questions;
    if (is_doubtful(best.candidate, problem_.limits)) {
      questions.emplace_back([&] {
        constexpr int kDraws = 20;  // of each of several speeds: the first will do
        return slow_enough(verdict_, best.replay, std::min(kDraws, best.candidate.spread->draws),
                           share_counted_on(problem_.limits));
      });
    }
    for (const Circumstance circumstance : kCircumstances) {
      questions.emplace_back([&, circumstance] {
        return what_if(circumstance, verdict_, best.replay, best.candidate.controls);
      });
    }
    std::vector<std::optional<WhatIf>> answers(questions.size());
    std::size_t next = 0;
    work_off([&]() -> std::optional<Piece> {
      const double left_s = budget_.left_s(TimeBudget::kAnswerShare);
      if (next == questions.size() || left_s <= 0) return std::nullopt;
      tell("asking what if", 0);
      const std::size_t i = next++;
      return Piece{.work = [&questions, i] { return bytes_of(questions[i]()); },
                   .time_limit_s = left_s,
                   .take =
                       [&answers, i](const std::optional<std::vector<char>>& bytes) {
                         if (bytes) answers[i] = from_bytes<WhatIf>(*bytes);
                       }};
    });
    for (std::optional<WhatIf>& answer : answers) {
      if (answer) result_.what_ifs.push_back(std::move(*answer));
    }
  }

  /// Why there is no path, and what to give up for one.
  std::string with_relaxation(const std::string& reason) {
    tell("looking for what would help", 0);
    result_.relaxed = relaxed_answers(problem_, budget_, session_.stop);
    std::vector<std::string> opening;
    for (const RelaxedAnswer& answer : result_.relaxed) {
      if (answer.opened) opening.push_back(answer.given_up);
    }
    if (opening.empty()) return reason;
    return fmt::format("{}; a verified path exists {}", reason, fmt::join(opening, ", or "));
  }

  PlanResult answered() {
    result_.interrupted = stopped();
    if (result_.status != PlanStatus::kFeasible) session_.on_answer(result_);
    return std::move(result_);
  }

  const PlanningProblem& problem_;
  const PlanSession& session_;
  TimeBudget budget_;
  World verdict_;
  std::optional<World> searched_;
  PlanResult result_;
  std::vector<RunResult> runs_;       ///< by number
  std::vector<VerifiedPath> paths_;   ///< that passed, by run
  std::vector<VerifiedPath> chosen_;  ///< the candidates
  std::vector<float> probability_;    ///< of the rasters
  int found_ = 0, verified_ = 0;
  double search_end_s_ = 0;
};

}  // namespace

PlanResult plan(const PlanningProblem& problem, const PlanSession& session,
                SingleThread /*alone*/) {
  validate(problem);
  return Planning(problem, session).run();
}

}  // namespace regoplan
