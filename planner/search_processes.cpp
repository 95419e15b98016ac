#include "planner/search_processes.h"

#include <cstring>
#include <stdexcept>
#include <type_traits>

#include "planner/child_processes.h"

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
  append(bytes, outcome.time_s);
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
    outcome.time_s = reader.take<double>();
    return outcome;
  } catch (const std::length_error&) {
    return std::nullopt;  // the child died before it had said all
  }
}

}  // namespace

void search_in_processes(
    const World& world, int processes, const std::function<std::optional<SearchRun>()>& next,
    const std::function<void(const SearchRun&, const std::optional<SearchOutcome>&)>& on_outcome,
    const std::stop_token& stop) {
  std::vector<SearchRun> runs;
  run_in_children(
      processes, AnswerOrder::kAsGiven,
      [&]() -> std::optional<ChildTask> {
        const std::optional<SearchRun> run = next();
        if (!run) return std::nullopt;
        runs.push_back(*run);
        return ChildTask{.work = [&world, run] { return packed(search(world, *run)); }};
      },
      [&](const ChildAnswer& answer) {
        on_outcome(runs[answer.task], answer.bytes ? unpacked(*answer.bytes) : std::nullopt);
      },
      stop);
}

}  // namespace regoplan
