#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "planner/problem/plan_result.h"

namespace regoplan {

/// Counts rejected states, and keeps an even sample of them, of each reason on its own.
class RejectionLog {
 public:
  explicit RejectionLog(std::uint64_t seed) : random_(seed) {}

  void add(const RejectedState& state);
  const std::array<std::int64_t, kRejectionCount>& counts() const { return counts_; }
  std::vector<RejectedState> sample() const;

 private:
  std::mt19937_64 random_;
  std::array<std::int64_t, kRejectionCount> counts_{};
  std::array<std::vector<RejectedState>, kRejectionCount> samples_;
};

}  // namespace regoplan
