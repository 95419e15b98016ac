#pragma once

namespace regoplan {

/// What a function takes that starts child processes: proof, made at the call, that the process has
/// one thread. A child is a copy of the process without its other threads: a lock that one of them
/// held, the allocator's or a library's, would stay locked in it for ever.
///
/// Whoever has more threads calls `plan` before they start, after they have ended, or from a
/// process of its own. To plan in one process and one thread, use `search` and `verify`.
class SingleThread {
 public:
  /// \throws std::logic_error saying how many threads there are, where there is more than one. One
  /// that has just been joined may take the system a moment to end; it is waited for.
  SingleThread();
  SingleThread(SingleThread&&) = default;
  SingleThread& operator=(SingleThread&&) = default;
};

}  // namespace regoplan
