#include "diagnosis/recording/neighbour_scatter.h"

#include <algorithm>
#include <cmath>

#include "diagnosis/recording/median.h"
#include "diagnosis/recording/thresholds.h"

namespace regoplan {
namespace {

/// Root mean square of values that are far off where they are farther than outliers lie: a median
/// alone would take tails for narrower than they are.
double winsorised_rms(const std::vector<double>& off, double rough) {
  const double most = Thresholds::kOutlier_deviations * rough;
  double sum = 0;
  for (const double value : off) sum += std::pow(std::min(value, most), 2);
  return std::sqrt(sum / static_cast<double>(off.size()));
}

}  // namespace

RunScatter neighbour_scatter(const std::vector<Condition>& conditions,
                             const std::vector<double>& value, const std::vector<double>& model) {
  struct Point {
    double s, b, l, residual;
  };
  std::vector<Point> points;
  for (const Condition& at : conditions) {
    for (const std::size_t run : at.runs) {
      if (!std::isfinite(value[run])) continue;
      points.push_back({at.slip_ratio / 0.1, at.slip_angle_rad / 0.1, std::log(at.load_n) / 0.3,
                        value[run] - model[run]});
    }
  }
  if (points.size() < 4) return {};
  std::vector<double> off;
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::vector<std::pair<double, double>> others;
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (k == i) continue;
      const double distance = std::hypot(points[k].s - points[i].s, points[k].b - points[i].b,
                                         points[k].l - points[i].l);
      others.emplace_back(distance, points[k].residual);
    }
    std::ranges::partial_sort(others, others.begin() + 2);
    off.push_back(std::abs(points[i].residual - (others[0].second + others[1].second) / 2));
  }
  const double rough = median(off) / kMedianOfNormal;
  // Each run is in about three differences, so these are not that many tellers of their own.
  constexpr int kShared = 3;
  return {std::max(rough, winsorised_rms(off, rough)) / std::sqrt(1.5),
          std::max(1, static_cast<int>(points.size()) / kShared)};
}

}  // namespace regoplan
