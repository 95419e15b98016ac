#include "drive_diagnosis/recording/robust_statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace regoplan {
namespace {

constexpr double kMedianOfNormal = 0.6745;  // of |x|

}  // namespace

double median_value(std::vector<double> values) {
  return quantile_value(std::move(values), 0.5);
}

double quantile_value(std::vector<double> values, double share) {
  std::ranges::sort(values);
  const double at = share * static_cast<double>(values.size() - 1);
  const auto low = static_cast<std::size_t>(at);
  const std::size_t high = std::min(low + 1, values.size() - 1);
  return values[low] + (at - static_cast<double>(low)) * (values[high] - values[low]);
}

MiddleAndScatter middle_and_scatter(std::vector<double> values) {
  const double middle = median_value(values);
  for (double& value : values) value = std::abs(value - middle);
  return {middle, median_value(std::move(values)) / kMedianOfNormal};
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const auto n = static_cast<double>(a.size());
  if (a.size() < 2) return 0;
  const double mean_a = std::accumulate(a.begin(), a.end(), 0.0) / n;
  const double mean_b = std::accumulate(b.begin(), b.end(), 0.0) / n;
  double aa = 0, bb = 0, ab = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    aa += (a[i] - mean_a) * (a[i] - mean_a);
    bb += (b[i] - mean_b) * (b[i] - mean_b);
    ab += (a[i] - mean_a) * (b[i] - mean_b);
  }
  return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : 0;
}

double scatter_of_samples(const std::vector<double>& time_s, const std::vector<double>& values) {
  constexpr std::size_t kNeighbours = 5;
  std::vector<double> sizes;
  for (std::size_t first = 0; first + kNeighbours <= values.size(); ++first) {
    // The fourth divided difference, which is 0 of any cubic.
    double sum = 0, squares = 0;
    for (std::size_t i = first; i < first + kNeighbours; ++i) {
      double weight = 1;
      for (std::size_t j = first; j < first + kNeighbours; ++j) {
        if (j != i) weight /= time_s[i] - time_s[j];
      }
      sum += weight * values[i];
      squares += weight * weight;
    }
    sizes.push_back(std::abs(sum) / std::sqrt(squares));
  }
  return sizes.empty() ? 0 : median_value(std::move(sizes)) / kMedianOfNormal;
}

double robust_ratio(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<std::pair<double, double>> ratios;  // and weights
  double total = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] == 0) continue;
    ratios.emplace_back(b[i] / a[i], std::abs(a[i]));
    total += std::abs(a[i]);
  }
  std::ranges::sort(ratios);
  double below = 0;
  for (const auto& [ratio, weight] : ratios) {
    below += weight;
    if (below >= total / 2) return ratio;
  }
  return 0;
}

}  // namespace regoplan
