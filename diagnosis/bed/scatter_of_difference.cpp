#include "diagnosis/bed/scatter_of_difference.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace regoplan {
namespace {

/// Pairs beyond what the surface takes.
constexpr Eigen::Index kFewestLeft = 6;

/// How far two conditions are apart: 1 where they are just no longer alike.
double apart(const Condition& a, const Condition& b) {
  if (a.conditions.pass != b.conditions.pass || a.conditions.speed_mps != b.conditions.speed_mps)
    return INFINITY;
  return std::hypot((a.slip_ratio - b.slip_ratio) / 0.03,
                    (a.slip_angle_rad - b.slip_angle_rad) / 0.03,
                    std::log(a.load_n / b.load_n) / 0.1);
}

/// A run of a channel: what the model leaves of it.
struct Left {
  std::size_t condition = 0;
  double value = 0;
};

std::vector<Left> left_of(const CondensedRecording& recording, std::size_t channel) {
  const TestBed& bed = recording.bed;
  const auto predicted = predict(bed, bed.setup.soil.mean, {});
  if (!predicted) return {};
  const std::vector<std::size_t>& conditions = bed.channels[channel].conditions;
  std::vector<Left> left;
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    const double model = (*predicted)[bed.offset(channel) + static_cast<Eigen::Index>(i)];
    for (const std::size_t run : bed.conditions[conditions[i]].runs) {
      const double value = recording.adjusted[channel][run];
      if (std::isfinite(value)) left.push_back({conditions[i], value - model});
    }
  }
  return left;
}

/// Of second order in slip ratio and slip angle, of first in the logarithm of the load.
Eigen::MatrixXd smooth_over(const std::vector<const Condition*>& at) {
  const auto n = static_cast<Eigen::Index>(at.size());
  Eigen::MatrixXd of(n, 7);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Condition& c = *at[static_cast<std::size_t>(i)];
    const double s = c.slip_ratio, b = c.slip_angle_rad, l = std::log(c.load_n / at[0]->load_n);
    of.row(i) << 1, s, b, l, s * s, s * b, b * b;
  }
  return of;
}

}  // namespace

std::optional<RunScatter> scatter_of_difference(const CondensedRecording& test,
                                                const CondensedRecording& reference,
                                                std::size_t channel) {
  std::vector<Left> others = left_of(reference, channel);
  std::vector<const Condition*> at;
  std::vector<double> difference;
  for (const Left& one : left_of(test, channel)) {
    const auto distance = [&](const Left& other) {
      return apart(test.bed.conditions[one.condition], reference.bed.conditions[other.condition]);
    };
    const auto nearest = std::ranges::min_element(others, {}, distance);
    if (nearest == others.end() || !(distance(*nearest) < 1)) continue;
    at.push_back(&test.bed.conditions[one.condition]);
    difference.push_back(one.value - nearest->value);
    others.erase(nearest);
  }
  if (difference.empty()) return std::nullopt;
  const auto n = static_cast<Eigen::Index>(difference.size());
  const Eigen::MatrixXd surface = smooth_over(at);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> fit(surface);
  const Eigen::Index left = n - fit.rank();
  if (left < kFewestLeft) return std::nullopt;
  const Eigen::Map<const Eigen::VectorXd> y(difference.data(), n);
  const double square = (y - surface * fit.solve(y)).squaredNorm();
  const double deviation =
      std::sqrt(square / static_cast<double>(left)) / std::numbers::sqrt2;  // of either
  return RunScatter{deviation, static_cast<int>(left)};
}

}  // namespace regoplan
