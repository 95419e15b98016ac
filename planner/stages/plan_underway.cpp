#include "planner/stages/plan_underway.h"

#include <cmath>
#include <utility>

#include "planner/runtime/child_processes.h"

namespace regoplan {

void work_off(const PlanUnderway& plan, const std::function<std::optional<Piece>()>& next) {
  std::vector<std::function<void(const std::optional<std::vector<char>>&)>> takers;
  run_in_children(
      plan.problem.search.threads, AnswerOrder::kAsEnded,
      [&]() -> std::optional<ChildTask> {
        std::optional<Piece> piece = next();
        if (!piece) return std::nullopt;
        takers.push_back(std::move(piece->take));
        ChildTask task{.work = std::move(piece->work),
                       .superfluous = std::move(piece->superfluous)};
        if (std::isfinite(piece->time_limit_s)) task.time_limit_s = piece->time_limit_s;
        return task;
      },
      [&](const ChildAnswer& answer) { takers[answer.task](answer.bytes); }, plan.stop);
}

}  // namespace regoplan
