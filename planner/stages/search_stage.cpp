#include "planner/stages/search_stage.h"

#include <algorithm>
#include <utility>

#include "planner/runtime/plain_bytes.h"
#include "planner/search/run_schedule.h"

namespace regoplan {
namespace {

/// What a run of the search came to, and its path.
struct RunResult {
  SearchRun run;
  std::optional<SearchOutcome> outcome;  ///< nothing where it was killed
  enum { kWaiting, kUnderway, kJudged } state = kWaiting;
  std::optional<VerifiedPath> path;

  bool found() const { return outcome && !outcome->controls.empty(); }
};

void count_rejected(const SearchOutcome& outcome, PlanResult& result) {
  for (std::size_t i = 0; i < outcome.rejected.size(); ++i) {
    result.rejected[i] += outcome.rejected[i];
  }
  result.rejected_states.insert(result.rejected_states.end(), outcome.rejected_states.begin(),
                                outcome.rejected_states.end());
}

double duration_s(const std::vector<ControlSegment>& controls) {
  double sum = 0;
  for (const ControlSegment& segment : controls) sum += segment.duration_s;
  return sum;
}

class SearchStage {
 public:
  explicit SearchStage(const PlanUnderway& plan)
      : plan_(plan),
        timed_(plan.problem.search.time_s.has_value()),
        search_end_s_(plan.budget.elapsed_s()) {}

  void run() {
    RunSchedule schedule(plan_.problem.search, plan_.problem.limits.margin_min,
                         plan_.searched_off_doubt != nullptr);
    work_off(plan_, [&]() -> std::optional<Piece> {
      const double runs = timed_ ? plan_.announcements.found() : schedule.given();
      plan_.announcements.stage("searching", std::min(1.0, runs / schedule.wanted()));
      if (auto piece = verification_of_most_promising()) return piece;
      const double left_s = plan_.budget.left_s(has_what_counts() ? kSearchShare : kFirstPathShare);
      const auto run = schedule.next(plan_.announcements.found(), left_s);
      if (!run) return std::nullopt;
      return search_piece(*run, schedule.wanted());
    });
  }

  SearchResult take(PlanResult& result) {
    SearchResult searched{.end = search_end(), .ended_s = search_end_s_};
    for (const RunResult& run : runs_) {
      if (!run.outcome) continue;
      // What keeping off doubtful soils forbids is no limit of the problem.
      if (!run.run.off_doubtful_soils) count_rejected(*run.outcome, result);
      result.propagations += run.outcome->propagations;
      if (!run.path) continue;
      if (run.path->candidate.verified.passed) {
        searched.paths.push_back(*run.path);
      } else {
        result.overturned.push_back(run.path->candidate);
      }
    }
    return searched;
  }

 private:
  /// A verified path; where soils are doubtful, one searched off them.
  bool has_what_counts() const {
    if (plan_.searched_off_doubt == nullptr) return plan_.announcements.verified() > 0;
    return std::ranges::any_of(runs_, [](const RunResult& run) {
      return run.run.off_doubtful_soils && run.path && run.path->candidate.verified.passed;
    });
  }

  Piece search_piece(const SearchRun& run, int wanted) {
    const std::size_t number = runs_.size();
    runs_.push_back({.run = run, .outcome = {}, .path = {}});
    return {
        .work =
            [this, run] {
              return bytes_of(search(plan_.searched_world(run.off_doubtful_soils), run));
            },
        .time_limit_s = plan_.budget.left_s(kFirstVerifyShare),
        .take =
            [this, number](const std::optional<std::vector<char>>& bytes) {
              RunResult& result = runs_[number];
              if (bytes) result.outcome = from_bytes<SearchOutcome>(*bytes);
              if (result.found()) plan_.announcements.path_found();
              search_end_s_ = plan_.budget.elapsed_s();
            },
        .superfluous = [this, wanted] { return timed_ && plan_.announcements.found() >= wanted; }};
  }

  /// The shortest of what is found and not judged yet.
  std::optional<Piece> verification_of_most_promising() {
    const double left_s = plan_.budget.left_s(has_what_counts() ? kVerifyShare : kFirstVerifyShare);
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
                         .controls = result.outcome->controls,
                         .off_doubtful_soils = result.run.off_doubtful_soils};
    return Piece{.work =
                     [this, path] {
                       const World& searched = plan_.searched_world(path.off_doubtful_soils);
                       return bytes_of(verify(plan_.verdict, searched, path));
                     },
                 .time_limit_s = plan_.budget.left_s(kFirstVerifyShare),
                 .take =
                     [this, number = *best](const std::optional<std::vector<char>>& bytes) {
                       RunResult& judged = runs_[number];
                       if (bytes) judged.path = from_bytes<VerifiedPath>(*bytes);
                       if (!judged.path) return;
                       judged.state = RunResult::kJudged;
                       if (judged.path->candidate.verified.passed) {
                         plan_.announcements.path_verified(judged.path->candidate);
                       }
                     }};
  }

  SearchEnd search_end() const {
    SearchEnd end{.found = plan_.announcements.found(),
                  .cut_short = true,
                  .interrupted = plan_.stop.stop_requested()};
    for (const RunResult& run : runs_) {
      if (run.found() && run.state != RunResult::kJudged) ++end.unverified;
      constexpr double kShare = 0.98;
      if (run.outcome && run.run.time_s && run.outcome->time_s < kShare * *run.run.time_s) {
        end.cut_short = false;
      }
    }
    return end;
  }

  const PlanUnderway& plan_;
  bool timed_;
  std::vector<RunResult> runs_;  ///< by number
  double search_end_s_;
};

}  // namespace

SearchResult search_and_verify(const PlanUnderway& plan, PlanResult& result) {
  SearchStage stage(plan);
  stage.run();
  return stage.take(result);
}

}  // namespace regoplan
