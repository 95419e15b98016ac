#include "planner/problem/margin_spread.h"

#include <algorithm>

namespace regoplan {

MarginSpread margin_spread(const std::vector<double>& smallest, double margin_min) {
  const auto allowed = std::count_if(smallest.begin(), smallest.end(),
                                     [&](double margin) { return margin >= margin_min; });
  constexpr double kLowest = MarginSpread::kBroken, kHighest = 1;
  const QuantileInterval interval =
      quantile_interval(smallest, 0.05, {.low = kLowest, .high = kHighest});
  const auto draws = static_cast<int>(smallest.size());
  return {.draws = draws,
          .p05 = quantiles_of(smallest).p05,
          .p05_low = interval.low,
          .p05_high = interval.high,
          .feasible = probability_of(static_cast<int>(allowed), draws)};
}

MarginSpread known_margin(double smallest, double margin_min) {
  const double share = smallest >= margin_min ? 1 : 0;
  return {.draws = 0,
          .p05 = smallest,
          .p05_low = smallest,
          .p05_high = smallest,
          .feasible = {.share = share, .low = share, .high = share}};
}

}  // namespace regoplan
