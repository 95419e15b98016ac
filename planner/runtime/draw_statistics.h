#pragma once

#include <vector>

namespace regoplan {

/// A share of draws with the interval that holds the true probability in 95 % of cases, by Wilson's
/// score.
struct Probability {
  double share = 0;
  double low = 0, high = 1;
};
Probability probability_of(int successes, int draws);

struct Quantiles {
  double p05 = 0, p50 = 0, p95 = 0;
};
/// By the nearest rank; `values` not empty.
Quantiles quantiles_of(std::vector<double> values);

/// What draws tell of a quantile.
struct QuantileInterval {
  double low = 0, high = 0;
};
/// The interval between two of the ordered draws that holds the true quantile in 95 % of cases,
/// whatever the distribution: the number of draws below it is binomial (David & Nagaraja, Order
/// Statistics, section 7.1). Where the draws are too few for an end, it is the given one.
QuantileInterval quantile_interval(std::vector<double> values, double share, QuantileInterval ends);

}  // namespace regoplan
