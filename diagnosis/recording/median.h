#pragma once

#include <algorithm>
#include <vector>

namespace regoplan {

inline constexpr double kMedianOfNormal = 0.6745;  ///< of |x|, in standard deviations of x

/// The middle value; the upper of the two in the middle. \pre not empty, no NaN
inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

}  // namespace regoplan
