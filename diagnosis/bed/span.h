#pragma once

#include <algorithm>
#include <cmath>

namespace regoplan {

/// From the least to the greatest of what it was given.
struct Span {
  double low = INFINITY, high = -INFINITY;

  void take(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  double width() const { return high - low; }
};

}  // namespace regoplan
