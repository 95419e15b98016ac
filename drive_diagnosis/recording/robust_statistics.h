#pragma once

#include <vector>

namespace regoplan {

/// The middle value; the mean of the two in the middle. \pre not empty, no NaN
double median_value(std::vector<double> values);

/// The value below which a share of them lies, interpolated. \pre not empty, no NaN
double quantile_value(std::vector<double> values, double share);

/// The median, and the standard deviation of a normal number of which half lie as near to it.
struct MiddleAndScatter {
  double middle = 0, scatter = 0;
};
/// \pre not empty, no NaN
MiddleAndScatter middle_and_scatter(std::vector<double> values);

/// Pearson's correlation of pairs; 0 where either does not vary.
double correlation(const std::vector<double>& a, const std::vector<double>& b);

/// The standard deviation of samples about what changes slowly, of which any five neighbours lie on
/// a cubic; in the median, so that jumps count little. 0 of fewer than five. \pre times rise
double scatter_of_samples(const std::vector<double>& time_s, const std::vector<double>& values);

/// The slope of b over a through the origin, from medians of ratios weighted by |a|: one value in
/// four may be anything.
double robust_ratio(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace regoplan
