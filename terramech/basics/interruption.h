#pragma once

#include <exception>
#include <stop_token>

namespace regoplan {

/// Leaves work that was asked to stop, from however deep within it. Whoever started the work
/// catches this and hands on what stands by then.
struct Interrupted : std::exception {
  const char* what() const noexcept override { return "interrupted"; }
};

/// To be called by long work every tenth of a second or more often.
/// \throws Interrupted once a stop is requested
inline void throw_if_stopped(const std::stop_token& stop) {
  if (stop.stop_requested()) throw Interrupted{};
}

}  // namespace regoplan
