#include "planner/runtime/child_processes.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <deque>
#include <exception>
#include <fstream>
#include <new>
#include <string_view>
#include <system_error>

#include "terramech/basics/input_error.h"

namespace regoplan {
namespace {

using Clock = std::chrono::steady_clock;

struct Child {
  std::size_t task = 0;
  pid_t pid = 0;
  int pipe = -1;
  std::optional<Clock::time_point> deadline;
  std::function<bool()> superfluous;
  std::vector<char> said;
  std::string killed_for;  ///< why it was, where it was
  bool done = false;
  ChildAnswer answer;
};

// The first byte of what a child says: an answer, or the text of an exception follows.
constexpr char kAnswer = 'a', kBadInput = 'i', kException = 'e';

void say(int pipe, const char* bytes, std::size_t size) {
  std::size_t written = 0;
  while (written < size) {
    const ssize_t n = write(pipe, bytes + written, size - written);
    if (n <= 0 && errno != EINTR) return;
    if (n > 0) written += static_cast<std::size_t>(n);
  }
}

void say_why(int pipe, char kind, const std::exception& bad) {
  const std::string_view why = bad.what();
  say(pipe, &kind, 1);
  say(pipe, why.data(), why.size());
}

/// Limits the address space to what is taken now and so much more.
void limit_memory(double more_mb) {
  std::ifstream stream("/proc/self/statm");
  std::size_t pages = 0;
  if (!(stream >> pages)) return;
  const std::size_t bytes = pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) +
                            static_cast<std::size_t>(more_mb * 1024 * 1024);
  const rlimit limit{.rlim_cur = bytes, .rlim_max = bytes};
  setrlimit(RLIMIT_AS, &limit);
}

[[noreturn]] void be_child(const ChildTask& task, int pipe) {
  // The parent decides what an interrupt means, and ends its children; they end with it.
  std::signal(SIGINT, SIG_IGN);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (task.memory_limit_mb) limit_memory(*task.memory_limit_mb);
  try {
    const std::vector<char> bytes = task.work();
    say(pipe, &kAnswer, 1);
    say(pipe, bytes.data(), bytes.size());
  } catch (const InputError& bad) {
    say_why(pipe, kBadInput, bad);
  } catch (const std::bad_alloc&) {
    constexpr std::string_view kWhy = "took more memory than it may";
    say(pipe, &kException, 1);
    say(pipe, kWhy.data(), kWhy.size());
  } catch (const std::exception& bad) {
    say_why(pipe, kException, bad);
  }
  _exit(0);
}

Child start(const ChildTask& task, std::size_t number) {
  int ends[2];
  if (pipe(ends) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  const pid_t pid = fork();
  if (pid < 0) throw std::system_error(errno, std::generic_category(), "fork");
  if (pid == 0) {
    close(ends[0]);
    be_child(task, ends[1]);
  }
  close(ends[1]);
  Child child{.task = number, .pid = pid, .pipe = ends[0], .superfluous = task.superfluous};
  if (task.time_limit_s) {
    child.deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                        std::chrono::duration<double>(*task.time_limit_s));
  }
  return child;
}

std::string failure_of(const Child& child, int status) {
  if (!child.killed_for.empty()) return child.killed_for;
  if (WIFSIGNALED(status))
    return fmt::format("ended by signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)));
  if (!child.said.empty() && child.said.front() != kAnswer) {
    return {child.said.begin() + 1, child.said.end()};
  }
  return "ended without an answer";
}

void finish(Child& child) {
  close(child.pipe);
  int status = 0;
  while (waitpid(child.pid, &status, 0) < 0 && errno == EINTR) {
  }
  child.done = true;
  child.answer.task = child.task;
  if (WIFEXITED(status) && !child.said.empty() && child.said.front() == kAnswer) {
    child.answer.bytes.emplace(child.said.begin() + 1, child.said.end());
  } else {
    child.answer.failure = failure_of(child, status);
    child.answer.bad_input = !child.said.empty() && child.said.front() == kBadInput;
  }
  child.said.clear();
}

/// Reads what children have to say; waits a little for it.
void listen(std::deque<Child>& children) {
  std::vector<pollfd> polled;
  polled.reserve(children.size());
  for (const Child& child : children) {
    polled.push_back({.fd = child.done ? -1 : child.pipe, .events = POLLIN, .revents = 0});
  }
  constexpr int kWait_ms = 50;
  if (poll(polled.data(), polled.size(), kWait_ms) <= 0) return;
  for (std::size_t i = 0; i < polled.size(); ++i) {
    if (polled[i].fd < 0 || polled[i].revents == 0) continue;
    char buffer[65536];
    const ssize_t n = read(children[i].pipe, buffer, sizeof buffer);
    if (n > 0) {
      children[i].said.insert(children[i].said.end(), buffer, buffer + n);
    } else if (n == 0 || errno != EINTR) {
      finish(children[i]);
    }
  }
}

void kill_late_and_superfluous(std::deque<Child>& children) {
  for (Child& child : children) {
    if (child.done || !child.killed_for.empty()) continue;
    if (child.deadline && Clock::now() >= *child.deadline) {
      child.killed_for = "took longer than it may";
    } else if (child.superfluous && child.superfluous()) {
      child.killed_for = "was wanted no longer";
    } else {
      continue;
    }
    kill(child.pid, SIGKILL);
  }
}

/// Ends every child on every way out.
class Brood {
 public:
  Brood() = default;
  Brood(const Brood&) = delete;
  Brood& operator=(const Brood&) = delete;
  ~Brood() { end_all(); }

  std::deque<Child> children;

  void end_all() {
    for (Child& child : children) {
      if (child.done) continue;
      kill(child.pid, SIGKILL);
      finish(child);
    }
    children.clear();
  }
};

}  // namespace

void run_in_children(int processes, AnswerOrder order,
                     const std::function<std::optional<ChildTask>()>& next,
                     const std::function<void(const ChildAnswer&)>& on_answer,
                     const std::stop_token& stop, const SingleThread& /*alone*/) {
  Brood brood;
  std::deque<Child>& children = brood.children;
  std::size_t given = 0;
  while (!stop.stop_requested()) {
    const auto running = std::count_if(children.begin(), children.end(),
                                       [](const Child& child) { return !child.done; });
    if (running < processes) {
      if (const std::optional<ChildTask> task = next()) {
        children.push_back(start(*task, given++));
        continue;
      }
    }
    if (children.empty()) return;
    listen(children);
    kill_late_and_superfluous(children);
    for (auto child = children.begin(); child != children.end();) {
      if (child->done) {
        const ChildAnswer answer = std::move(child->answer);
        child = children.erase(child);
        on_answer(answer);
      } else if (order == AnswerOrder::kAsGiven) {
        break;
      } else {
        ++child;
      }
    }
  }
  for (const Child& child : children) {
    if (child.done) on_answer(child.answer);
  }
}

}  // namespace regoplan
