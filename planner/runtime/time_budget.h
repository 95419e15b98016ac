#pragma once

#include <algorithm>
#include <chrono>
#include <limits>
#include <optional>

namespace regoplan {

/// The time that an answer may take as a whole. Without a budget nothing ever is due.
class TimeBudget {
 public:
  using Clock = std::chrono::steady_clock;

  /// When the answer stands; what is left is for writing it down.
  static constexpr double kAnswerShare = 0.96;

  TimeBudget(Clock::time_point started, std::optional<double> whole_s)
      : started_(started), whole_s_(whole_s) {}

  double elapsed_s() const {
    return std::chrono::duration<double>(Clock::now() - started_).count();
  }
  /// Until a share of the whole time is over: infinite without a budget, 0 when it is over.
  double left_s(double share) const {
    if (!whole_s_) return std::numeric_limits<double>::infinity();
    return std::max(0.0, share * *whole_s_ - elapsed_s());
  }
  std::optional<double> whole_s() const { return whole_s_; }

 private:
  Clock::time_point started_;
  std::optional<double> whole_s_;
};

}  // namespace regoplan
