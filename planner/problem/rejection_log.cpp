#include "planner/problem/rejection_log.h"

namespace regoplan {

void RejectionLog::add(const RejectedState& state) {
  constexpr std::size_t kKept = 30;
  const auto reason = static_cast<std::size_t>(state.reason);
  const auto seen = static_cast<std::uint64_t>(counts_[reason]++);
  std::vector<RejectedState>& kept = samples_[reason];
  if (kept.size() < kKept) {
    kept.push_back(state);
    return;
  }
  const std::uint64_t place = std::uniform_int_distribution<std::uint64_t>(0, seen)(random_);
  if (place < kKept) kept[place] = state;
}

std::vector<RejectedState> RejectionLog::sample() const {
  std::vector<RejectedState> all;
  for (const auto& kept : samples_) all.insert(all.end(), kept.begin(), kept.end());
  return all;
}

}  // namespace regoplan
