#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "planner/runtime/single_thread.h"

namespace regoplan {

/// Work for a process of its own.
struct ChildTask {
  std::function<std::vector<char>()> work;  ///< its answer, as bytes
  std::optional<double> time_limit_s{};     ///< killed when it takes longer
  /// What it may take beyond what the parent has; an allocation beyond that fails.
  std::optional<double> memory_limit_mb{};
  std::function<bool()> superfluous{};  ///< asked of the parent now and then; true: it is killed
};

/// What a child came to.
struct ChildAnswer {
  std::size_t task = 0;  ///< number, in the order in which tasks were given, from 0
  std::optional<std::vector<char>> bytes;  ///< nothing where it failed
  std::string failure;                     ///< why: its exception, its signal, its time
  bool bad_input = false;                  ///< the exception was an InputError
};

/// When answers are handed over.
enum class AnswerOrder {
  kAsGiven,  ///< in the order of the tasks, so that what follows does not hang on the clock
  kAsEnded   ///< at once
};

/// Runs tasks in child processes, several at once: a crash or a leak of one costs one task. Ends
/// early, killing what runs and giving no answer for it, when stop is requested. \param next gives
/// the next task, nothing where there is none at the moment: it is asked again when an answer has
/// come, and the end is reached when nothing runs and there is none
void run_in_children(int processes, AnswerOrder order,
                     const std::function<std::optional<ChildTask>()>& next,
                     const std::function<void(const ChildAnswer&)>& on_answer,
                     const std::stop_token& stop, const SingleThread& alone = {});

}  // namespace regoplan
