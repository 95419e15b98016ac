#include "planner/following/braking_in_time.h"

#include <algorithm>
#include <cmath>

namespace regoplan {

BrakingInTime::BrakingInTime(const PathLeg& leg, double apart_m, double rate_mps2,
                             const std::function<double(double s_m)>& rim_mps)
    : leg_(leg), rate_mps2_(rate_mps2) {
  constexpr double kMost = 40000;  // stations, as of trims
  const double length_m = leg.length_m();
  const auto pieces =
      std::max(2, static_cast<int>(std::ceil(length_m / std::max(apart_m, length_m / kMost))));
  apart_m_ = length_m / pieces;
  most_mps_.resize(static_cast<std::size_t>(pieces) + 1);
  most_mps_.back() = rim_mps(length_m);
  for (std::size_t i = most_mps_.size() - 1; i-- > 0;) {
    const double s_m = static_cast<double>(i) * apart_m_;
    most_mps_[i] = std::min(rim_mps(s_m), most_mps(s_m));
  }
}

double BrakingInTime::most_mps(double s_m) const {
  const auto next = std::min(static_cast<std::size_t>(std::max(0.0, s_m / apart_m_ + 1e-9)) + 1,
                             most_mps_.size() - 1);
  const double time_s =
      leg_.speed.duration_s(static_cast<double>(next) * apart_m_) - leg_.speed.duration_s(s_m);
  return most_mps_[next] + rate_mps2_ * std::max(0.0, time_s);
}

}  // namespace regoplan
