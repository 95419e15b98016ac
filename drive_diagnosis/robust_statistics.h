#pragma once

#include <vector>

namespace regoplan {

/// The middle value; the mean of the two in the middle. \pre not empty, no NaN
double median_value(std::vector<double> values);

/// The value below which a share of them lies, interpolated. \pre not empty, no NaN
double quantile_value(std::vector<double> values, double share);

/// Pearson's correlation of pairs; 0 where either does not vary.
double correlation(const std::vector<double>& a, const std::vector<double>& b);

/// The slope of b over a through the origin, from medians of ratios weighted by |a|: one value in
/// four may be anything.
double robust_ratio(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace regoplan
