#include "planner/runtime/draw_statistics.h"

#include <algorithm>
#include <cmath>

namespace regoplan {

Probability probability_of(int successes, int draws) {
  constexpr double kZ = 1.959963984540054;  // 97.5 % quantile of the normal distribution
  const double n = draws, p = successes / n;
  const double middle = (p + kZ * kZ / (2 * n)) / (1 + kZ * kZ / n);
  const double half = kZ / (1 + kZ * kZ / n) * std::sqrt(p * (1 - p) / n + kZ * kZ / (4 * n * n));
  return {.share = p,
          .low = successes == 0 ? 0 : std::max(0.0, middle - half),
          .high = successes == draws ? 1 : std::min(1.0, middle + half)};
}

Quantiles quantiles_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) {
    const auto below = static_cast<std::size_t>(share * static_cast<double>(values.size()));
    return values[std::min(below, values.size() - 1)];
  };
  return {.p05 = at(0.05), .p50 = at(0.5), .p95 = at(0.95)};
}

QuantileInterval quantile_interval(std::vector<double> values, double share,
                                   QuantileInterval ends) {
  constexpr double kTail = 0.025;
  std::sort(values.begin(), values.end());
  const auto n = static_cast<int>(values.size());
  const auto probability = [&](int k) {  // that k draws lie below the quantile
    return std::exp(std::lgamma(n + 1.0) - std::lgamma(k + 1.0) - std::lgamma(n - k + 1.0) +
                    k * std::log(share) + (n - k) * std::log1p(-share));
  };
  double at_most = 0;
  for (int k = 0; k < n; ++k) {
    at_most += probability(k);
    const double value = values[static_cast<std::size_t>(k)];
    if (at_most <= kTail) ends.low = value;
    if (at_most >= 1 - kTail) {
      ends.high = value;
      break;
    }
  }
  return ends;
}

}  // namespace regoplan
