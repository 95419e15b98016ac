#include "planner/search/search_processes.h"

#include "planner/runtime/child_processes.h"

namespace regoplan {

void search_in_processes(
    const World& world, int processes, const std::function<std::optional<SearchRun>()>& next,
    const std::function<void(const SearchRun&, const std::optional<SearchOutcome>&)>& on_outcome,
    const std::stop_token& stop, const SingleThread& alone) {
  std::vector<SearchRun> runs;
  run_in_children(
      processes, AnswerOrder::kAsGiven,
      [&]() -> std::optional<ChildTask> {
        const std::optional<SearchRun> run = next();
        if (!run) return std::nullopt;
        runs.push_back(*run);
        return ChildTask{.work = [&world, run] { return bytes_of(search(world, *run)); }};
      },
      [&](const ChildAnswer& answer) {
        on_outcome(runs[answer.task],
                   answer.bytes ? from_bytes<SearchOutcome>(*answer.bytes) : std::nullopt);
      },
      stop, alone);
}

}  // namespace regoplan
