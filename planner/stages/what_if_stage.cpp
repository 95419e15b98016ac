#include "planner/stages/what_if_stage.h"

#include <algorithm>
#include <utility>

#include "planner/driving/what_if.h"
#include "planner/runtime/plain_bytes.h"
#include "planner/verdict/ranking.h"

namespace regoplan {

std::vector<WhatIf> answered_what_ifs(const PlanUnderway& plan, const VerifiedPath& best) {
  std::vector<std::function<WhatIf()>> questions;
  if (is_doubtful(best.candidate, plan.problem.limits)) {
    questions.emplace_back([&] {
      constexpr int kDraws = 20;  // of each of several speeds: the first will do
      return slow_enough(plan.verdict, best.replay, std::min(kDraws, best.candidate.spread->draws),
                         share_counted_on(plan.problem.limits));
    });
  }
  for (const Circumstance circumstance : kCircumstances) {
    questions.emplace_back([&, circumstance] {
      return what_if(circumstance, plan.verdict, best.replay, best.candidate.controls);
    });
  }
  std::vector<std::optional<WhatIf>> answers(questions.size());
  std::size_t next = 0;
  work_off(plan, [&]() -> std::optional<Piece> {
    const double left_s = plan.budget.left_s(TimeBudget::kAnswerShare);
    if (next == questions.size() || left_s <= 0) return std::nullopt;
    plan.announcements.stage("asking what if", 0);
    const std::size_t i = next++;
    return Piece{.work = [&questions, i] { return bytes_of(questions[i]()); },
                 .time_limit_s = left_s,
                 .take =
                     [&answers, i](const std::optional<std::vector<char>>& bytes) {
                       if (bytes) answers[i] = from_bytes<WhatIf>(*bytes);
                     }};
  });
  std::vector<WhatIf> answered;
  for (std::optional<WhatIf>& answer : answers) {
    if (answer) answered.push_back(std::move(*answer));
  }
  return answered;
}

}  // namespace regoplan
