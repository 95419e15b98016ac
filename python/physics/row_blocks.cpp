#include "python/physics/row_blocks.h"

#include <pybind11/pybind11.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace regoplan::python {
namespace {

namespace py = pybind11;

/// Asks Python every 50 ms whether a signal's handler has thrown.
class SignalWatch {
 public:
  bool thrown() {
    const auto now = std::chrono::steady_clock::now();
    if (now < next_) return false;
    next_ = now + kEvery;
    const py::gil_scoped_acquire lock;
    return PyErr_CheckSignals() != 0;
  }

 private:
  static constexpr auto kEvery = std::chrono::milliseconds(50);
  std::chrono::steady_clock::time_point next_ = std::chrono::steady_clock::now() + kEvery;
};

/// The blocks, handed out in order, and the first that failed.
struct Blocks {
  std::size_t rows;
  std::size_t block;
  const std::function<void(std::size_t, std::size_t)>& work;
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> ended = false;
  std::mutex failing = {};
  std::size_t failed_at = 0;
  std::exception_ptr failure = nullptr;

  bool work_off_one() {
    if (ended) return false;
    const std::size_t first = next.fetch_add(block);
    if (first >= rows) return false;
    try {
      work(first, std::min(block, rows - first));
    } catch (...) {
      ended = true;
      const std::lock_guard lock(failing);
      if (!failure || first < failed_at) {
        failed_at = first;
        failure = std::current_exception();
      }
    }
    return true;
  }
};

}  // namespace

void for_each_block(std::size_t rows, std::size_t block, int threads,
                    const std::function<void(std::size_t first, std::size_t count)>& work) {
  Blocks blocks{.rows = rows, .block = block, .work = work};
  bool signalled = false;
  {
    const py::gil_scoped_release unlocked;
    std::vector<std::jthread> others;
    const std::size_t worth = (rows + block - 1) / block;
    for (std::size_t i = 1; i < std::min(static_cast<std::size_t>(threads), worth); ++i) {
      others.emplace_back([&blocks] {
        while (blocks.work_off_one()) {
        }
      });
    }
    SignalWatch watch;
    while (blocks.work_off_one()) {
      if (!watch.thrown()) continue;
      signalled = true;
      blocks.ended = true;
    }
  }
  if (signalled) throw py::error_already_set();
  if (blocks.failure) std::rethrow_exception(blocks.failure);
}

}  // namespace regoplan::python
