#include "planner/runtime/single_thread.h"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <iterator>
#include <stdexcept>
#include <thread>

namespace regoplan {
namespace {

/// 1 where the system does not tell.
std::ptrdiff_t thread_count() {
  std::error_code untold;
  const std::filesystem::directory_iterator threads("/proc/self/task", untold);
  return untold ? 1 : std::distance(begin(threads), end(threads));
}

#ifdef __SANITIZE_THREAD__
constexpr std::ptrdiff_t kMost = 2;  // ThreadSanitizer runs one of its own
#else
constexpr std::ptrdiff_t kMost = 1;
#endif

}  // namespace

SingleThread::SingleThread() {
  using namespace std::chrono_literals;
  constexpr int kTries = 200;
  for (int i = 0; i < kTries; ++i) {
    if (thread_count() <= kMost) return;
    std::this_thread::sleep_for(1ms);
  }
  throw std::logic_error(
      fmt::format("the process has {} threads, and what starts child processes must have one: a "
                  "child would inherit the locks of the others, held for ever",
                  thread_count()));
}

}  // namespace regoplan
