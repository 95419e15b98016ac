#include "planner/search_processes.h"

#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <deque>
#include <exception>
#include <system_error>
#include <type_traits>

namespace regoplan {
namespace {

/// Plain values to and from bytes; both ends are the same program.
template <class Value>
void append(std::vector<char>& bytes, const Value& value) {
  static_assert(std::is_trivially_copyable_v<Value>);
  const std::size_t at = bytes.size();
  bytes.resize(at + sizeof(Value));
  std::memcpy(bytes.data() + at, &value, sizeof(Value));
}

template <class Value>
void append_all(std::vector<char>& bytes, const std::vector<Value>& values) {
  append(bytes, values.size());
  for (const Value& value : values) append(bytes, value);
}

class Reader {
 public:
  explicit Reader(const std::vector<char>& bytes) : bytes_(bytes) {}

  template <class Value>
  Value take() {
    if (at_ + sizeof(Value) > bytes_.size()) throw std::length_error("outcome cut short");
    Value value;
    std::memcpy(&value, bytes_.data() + at_, sizeof(Value));
    at_ += sizeof(Value);
    return value;
  }
  template <class Value>
  std::vector<Value> take_all() {
    std::vector<Value> values(take<std::size_t>());
    for (Value& value : values) value = take<Value>();
    return values;
  }

 private:
  const std::vector<char>& bytes_;
  std::size_t at_ = 0;
};

std::vector<char> packed(const SearchOutcome& outcome) {
  std::vector<char> bytes;
  append_all(bytes, outcome.controls);
  append(bytes, outcome.rejected);
  append_all(bytes, outcome.rejected_states);
  append(bytes, outcome.propagations);
  return bytes;
}

std::optional<SearchOutcome> unpacked(const std::vector<char>& bytes) {
  try {
    Reader reader(bytes);
    SearchOutcome outcome;
    outcome.controls = reader.take_all<ControlSegment>();
    outcome.rejected = reader.take<decltype(outcome.rejected)>();
    outcome.rejected_states = reader.take_all<RejectedState>();
    outcome.propagations = reader.take<std::int64_t>();
    return outcome;
  } catch (const std::length_error&) {
    return std::nullopt;  // the child died before it had said all
  }
}

/// A run in a child process.
struct Child {
  SearchRun run;
  pid_t pid = 0;
  int pipe = -1;
  std::vector<char> bytes;
  bool done = false;
};

[[noreturn]] void be_child(const World& world, const SearchRun& run, int pipe) {
  // The parent decides what an interrupt means, and ends its children.
  std::signal(SIGINT, SIG_IGN);
  int status = 1;
  try {
    const std::vector<char> bytes = packed(search(world, run));
    std::size_t written = 0;
    while (written < bytes.size()) {
      const ssize_t n = write(pipe, bytes.data() + written, bytes.size() - written);
      if (n <= 0 && errno != EINTR) break;
      if (n > 0) written += static_cast<std::size_t>(n);
    }
    status = 0;
  } catch (const std::exception&) {
    status = 1;  // an outcome that is missing says so
  }
  _exit(status);
}

Child start(const World& world, const SearchRun& run) {
  int ends[2];
  if (pipe(ends) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  const pid_t pid = fork();
  if (pid < 0) throw std::system_error(errno, std::generic_category(), "fork");
  if (pid == 0) {
    close(ends[0]);
    be_child(world, run, ends[1]);
  }
  close(ends[1]);
  return {.run = run, .pid = pid, .pipe = ends[0], .bytes = {}, .done = false};
}

void finish(Child& child) {
  close(child.pipe);
  waitpid(child.pid, nullptr, 0);
  child.done = true;
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
      children[i].bytes.insert(children[i].bytes.end(), buffer, buffer + n);
    } else if (n == 0 || errno != EINTR) {
      finish(children[i]);
    }
  }
}

}  // namespace

void search_in_processes(
    const World& world, int processes, const std::function<std::optional<SearchRun>()>& next,
    const std::function<void(const SearchRun&, const std::optional<SearchOutcome>&)>& on_outcome,
    const std::stop_token& stop) {
  std::deque<Child> children;
  bool more = true;
  while (true) {
    const auto running = std::count_if(children.begin(), children.end(),
                                       [](const Child& child) { return !child.done; });
    if (more && !stop.stop_requested() && running < processes) {
      const std::optional<SearchRun> run = next();
      more = run.has_value();
      if (run) children.push_back(start(world, *run));
      continue;
    }
    if (children.empty()) return;
    if (stop.stop_requested()) {
      for (Child& child : children) {
        if (!child.done) kill(child.pid, SIGKILL);
      }
      more = false;
    }
    listen(children);
    while (!children.empty() && children.front().done) {
      const Child child = std::move(children.front());
      children.pop_front();
      on_outcome(child.run, unpacked(child.bytes));
    }
  }
}

}  // namespace regoplan
