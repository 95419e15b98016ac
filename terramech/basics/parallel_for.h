#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace regoplan {

/// Calls work(i) for every i below `count`, in any order, from several threads. Where work throws,
/// nothing new is begun, and what was thrown first is thrown on once all threads have ended.
template <class Work>
void parallel_for(std::size_t count, int threads, const Work& work) {
  std::atomic<std::size_t> next = 0;
  std::exception_ptr thrown;
  std::once_flag first;
  const auto run = [&] {
    try {
      for (std::size_t i = next++; i < count; i = next++) work(i);
    } catch (...) {
      next = count;
      std::call_once(first, [&] { thrown = std::current_exception(); });
    }
  };
  {
    std::vector<std::jthread> others;
    for (int k = 1; k < threads && static_cast<std::size_t>(k) < count; ++k) {
      others.emplace_back(run);
    }
    run();
  }
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace regoplan
