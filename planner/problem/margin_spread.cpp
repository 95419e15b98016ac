#include "planner/problem/margin_spread.h"

#include <algorithm>

namespace regoplan {

MarginSpread margin_spread(const std::vector<double>& smallest, double margin_min) {
  const auto allowed = std::count_if(smallest.begin(), smallest.end(),
                                     [&](double margin) { return margin >= margin_min; });
  constexpr double kLowest = MarginSpread::kBroken, kHighest = 1;
  constexpr QuantileInterval kEnds{.low = kLowest, .high = kHighest};
  const QuantileInterval low_tail = quantile_interval(smallest, 0.05, kEnds),
                         middle = quantile_interval(smallest, 0.5, kEnds);
  const Quantiles quantiles = quantiles_of(smallest);
  const auto draws = static_cast<int>(smallest.size());
  return {.draws = draws,
          .p05 = quantiles.p05,
          .p05_low = low_tail.low,
          .p05_high = low_tail.high,
          .p50 = quantiles.p50,
          .p50_low = middle.low,
          .p50_high = middle.high,
          .feasible = probability_of(static_cast<int>(allowed), draws)};
}

MarginSpread known_margin(double smallest, double margin_min) {
  const double share = smallest >= margin_min ? 1 : 0;
  return {.draws = 0,
          .p05 = smallest,
          .p05_low = smallest,
          .p05_high = smallest,
          .p50 = smallest,
          .p50_low = smallest,
          .p50_high = smallest,
          .feasible = {.share = share, .low = share, .high = share}};
}

}  // namespace regoplan
