#include "planner/plan.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>
#include <string_view>
#include <utility>

#include "planner/certificate/relaxed_problem.h"
#include "planner/certificate/undecided.h"
#include "planner/chart/doubtful_soils.h"
#include "planner/driving/crash_ahead.h"
#include "planner/problem/changed_problem.h"
#include "planner/problem/rejection_text.h"
#include "planner/relaxation.h"
#include "planner/stages/draws_stage.h"
#include "planner/stages/improvement_stage.h"
#include "planner/stages/search_stage.h"
#include "planner/stages/what_if_stage.h"
#include "planner/verdict/ranking.h"

namespace regoplan {
namespace {

/// Why nothing may be planned from here, where the start itself may not be.
std::optional<std::string> start_certificate(const World& verdict) {
  const auto rejection = verdict.rejected(verdict.start(), {});
  if (!rejection) return std::nullopt;
  return "the vehicle may not stand at its start: " + rejection_text(*rejection);
}

/// Whether the start is an end: at rest in the goal, heading as it asks.
bool stands_in_goal(const World& verdict) {
  const VehicleState start = verdict.start();
  return verdict.dynamics().at_rest(start) && verdict.within_goal(start);
}

constexpr std::string_view kLookingForHelp = "looking for what would help";

/// One plan on its way.
class Planning {
 public:
  Planning(const PlanningProblem& problem, const PlanSession& session)
      : problem_(problem),
        session_(session),
        budget_(session.started, problem.search.time_s),
        announcements_(session, budget_),
        begun_s_(budget_.elapsed_s()),
        verdict_(problem, WorldUse::kVerdict, problem.search.threads) {
    result_.seed = problem.search.seed;
    result_.before_search.push_back(
        {.step = "reading the scenario and its map", .time_s = begun_s_});
    timed("rocks and known ground");
  }

  PlanResult run() && {
    result_.certificate = start_certificate(verdict_);
    const bool can_stand = !result_.certificate;
    if (can_stand && stands_in_goal(verdict_)) {
      result_.status = PlanStatus::kFeasible;
      result_.reason = "the vehicle stands in its goal already, there is no way to go";
      return answered();
    }
    if (can_stand) result_.certificate = certificate_of_infeasibility(problem_);
    timed("certificates");
    if (result_.certificate) {
      result_.status = PlanStatus::kInfeasible;
      // The refusal of a start says itself what would have to give way.
      if (can_stand) {
        announcements_.stage(kLookingForHelp, 0);
        result_.relaxed = relaxed_search(problem_, nullptr, budget_, session_.stop).answers;
      }
      result_.reason = with_relaxation(*result_.certificate);
      return answered();
    }
    announcements_.stage("preparing", 0);
    const World searched(problem_, WorldUse::kSearch, problem_.search.threads);
    result_.doubtful_soils = doubtful_soils(problem_);
    std::optional<PlanningProblem> off_doubt;
    std::optional<World> searched_off_doubt;
    if (!result_.doubtful_soils.empty()) {
      off_doubt = with_soils_forbidden(problem_, result_.doubtful_soils);
      searched_off_doubt.emplace(*off_doubt, WorldUse::kSearch, problem_.search.threads);
    }
    const PlanUnderway plan{
        .problem = problem_,
        .verdict = verdict_,
        .searched = searched,
        .searched_off_doubt = searched_off_doubt ? &*searched_off_doubt : nullptr,
        .budget = budget_,
        .stop = session_.stop,
        .announcements = announcements_};
    timed("force tables and doubtful soils");
    const double search_start_s = budget_.elapsed_s();
    SearchResult found = search_and_verify(plan, result_);
    result_.planning_time_s = found.ended_s - search_start_s;
    chosen_ = improved_choice(plan, std::move(found.paths));
    draw_soils(plan, chosen_, result_);
    result_.verification_time_s = budget_.elapsed_s() - found.ended_s;
    result_.first_verified_s = announcements_.first_verified_s();
    decide(plan, found.end);
    return answered();
  }

 private:
  bool stopped() const { return session_.stop.stop_requested(); }

  /// Notes what a step took that ends now.
  void timed(const char* step) {
    const double now_s = budget_.elapsed_s();
    result_.before_search.push_back({.step = step, .time_s = now_s - begun_s_});
    begun_s_ = now_s;
  }

  /// Takes away what does not keep the chance constraint. \returns how many
  std::size_t drop_improbable() {
    return std::erase_if(chosen_, [&](const VerifiedPath& path) {
      return !probable_enough(path.candidate, problem_.limits);
    });
  }

  /// Where the searches came to no path: what would open the way. A path that is found so and needs
  /// no change after all is a candidate as any other. \returns how many paths were improbable
  std::size_t look_for_what_would_help(const PlanUnderway& plan) {
    announcements_.stage(kLookingForHelp, 0);
    RelaxedSearch search = relaxed_search(problem_, &verdict_, budget_, session_.stop);
    result_.relaxed = std::move(search.answers);
    if (!search.within_limits) return 0;
    announcements_.path_verified(search.within_limits->candidate);
    result_.first_verified_s = announcements_.first_verified_s();
    chosen_.push_back(*std::move(search.within_limits));
    draw_soils(plan, chosen_, result_);
    return drop_improbable();
  }

  void decide(const PlanUnderway& plan, const SearchEnd& end) {
    std::size_t left_out = drop_improbable();
    const bool searches_sufficed = !chosen_.empty();
    if (!searches_sufficed) left_out += look_for_what_would_help(plan);
    rank(chosen_);
    for (const VerifiedPath& path : chosen_) result_.candidates.push_back(path.candidate);
    const std::string improbable =
        left_out == 0 ? ""
                      : fmt::format("{} verified, but not with probability {:.4g} over the soils",
                                    left_out, problem_.limits.probability_min);
    if (!chosen_.empty()) {
      result_.status = PlanStatus::kFeasible;
      result_.reason = fmt::format(
          "{} verified {}{}{}{}", chosen_.size(), chosen_.size() == 1 ? "path" : "different paths",
          searches_sufficed ? "" : found_otherwise(), improbable.empty() ? "" : "; ", improbable);
      result_.relaxed.clear();
      result_.interrupted = stopped();
      session_.on_answer(result_);
      told_ = true;
      // What a relaxed search found has steps of its own, by which no what-if drives it.
      if (searches_sufficed) result_.what_ifs = answered_what_ifs(plan, chosen_.front());
    } else {
      const std::string why =
          improbable.empty() ? why_undecided(problem_, result_, end) : improbable;
      const std::optional<std::string> crash = crash_ahead(verdict_);
      result_.reason = with_relaxation(crash ? fmt::format("{}; {}", *crash, why) : why);
    }
  }

  /// That the planner that was asked for has not found what stands as the answer.
  std::string found_otherwise() const {
    return fmt::format(", which a brief search by {} found and those by {} did not",
                       chosen_.front().candidate.planner, problem_.search.planner);
  }

  /// Why there is no path, and what to give up for one.
  std::string with_relaxation(const std::string& reason) const {
    std::vector<std::string> opening;
    for (const RelaxedAnswer& answer : result_.relaxed) {
      if (answer.opened) opening.push_back(answer.given_up);
    }
    if (opening.empty()) return reason;
    return fmt::format("{}; a verified path exists {}", reason, fmt::join(opening, ", or "));
  }

  PlanResult answered() {
    result_.interrupted = stopped();
    if (!told_) session_.on_answer(result_);
    return std::move(result_);
  }

  const PlanningProblem& problem_;
  const PlanSession& session_;
  TimeBudget budget_;
  Announcements announcements_;
  bool told_ = false;  ///< whether the answer was announced
  double begun_s_;     ///< when the step on its way began
  World verdict_;
  PlanResult result_;
  std::vector<VerifiedPath> chosen_;  ///< the candidates
};

}  // namespace

PlanResult plan(const PlanningProblem& problem, const PlanSession& session,
                SingleThread /*alone*/) {
  validate(problem);
  return Planning(problem, session).run();
}

}  // namespace regoplan
