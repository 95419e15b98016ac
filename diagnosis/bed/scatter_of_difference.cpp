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

/// Runs of two recordings at like conditions, each of one pair at most.
struct Pair {
  std::size_t test = 0, reference = 0;  // runs
  std::size_t test_condition = 0, reference_condition = 0;
};

std::vector<Pair> pairs_of(const TestBed& test, const TestBed& reference) {
  std::vector<std::pair<std::size_t, std::size_t>> others;  // run and condition
  for (std::size_t k = 0; k < reference.conditions.size(); ++k) {
    for (const std::size_t run : reference.conditions[k].runs) others.emplace_back(run, k);
  }
  std::vector<Pair> pairs;
  for (std::size_t k = 0; k < test.conditions.size(); ++k) {
    for (const std::size_t run : test.conditions[k].runs) {
      const auto distance = [&](const auto& other) {
        return apart(test.conditions[k], reference.conditions[other.second]);
      };
      const auto nearest = std::ranges::min_element(others, {}, distance);
      if (nearest == others.end() || !(distance(*nearest) < 1)) continue;
      pairs.push_back({run, nearest->first, k, nearest->second});
      others.erase(nearest);
    }
  }
  return pairs;
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

/// What a surface leaves of a difference; nothing where too few values are left.
std::optional<RunScatter> scatter_about_surface(const std::vector<const Condition*>& at,
                                                const std::vector<double>& difference) {
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

/// By condition, of every channel: what the model has there; not a number where it is not measured.
std::vector<std::vector<double>> modelled(const TestBed& bed) {
  std::vector<std::vector<double>> all(
      bed.channels.size(), std::vector<double>(bed.conditions.size(), WheelRun::kNotMeasured));
  const auto predicted = predict(bed, bed.setup.soil.mean, {});
  if (!predicted) return all;
  for (std::size_t c = 0; c < bed.channels.size(); ++c) {
    Eigen::Index row = bed.offset(c);
    for (const std::size_t k : bed.channels[c].conditions) all[c][k] = (*predicted)[row++];
  }
  return all;
}

}  // namespace

std::vector<std::optional<RunScatter>> scatter_of_difference(const CondensedRecording& test,
                                                             const CondensedRecording& reference) {
  const std::vector<Pair> pairs = pairs_of(test.bed, reference.bed);
  const auto of_test = modelled(test.bed), of_reference = modelled(reference.bed);
  std::vector<std::optional<RunScatter>> scatter;
  for (std::size_t c = 0; c < test.bed.channels.size(); ++c) {
    std::vector<const Condition*> at;
    std::vector<double> difference;
    for (const Pair& pair : pairs) {
      const double of_pair = test.adjusted[c][pair.test] - of_test[c][pair.test_condition] -
                             reference.adjusted[c][pair.reference] +
                             of_reference[c][pair.reference_condition];
      if (!std::isfinite(of_pair)) continue;
      at.push_back(&test.bed.conditions[pair.test_condition]);
      difference.push_back(of_pair);
    }
    scatter.push_back(scatter_about_surface(at, difference));
  }
  return scatter;
}

}  // namespace regoplan
