#include "drive_diagnosis/recording/sample_smoothing.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace regoplan {

double SampleSmoothing::at(double t_s) const {
  return value + (std::isnan(slope) ? 0 : slope * t_s) + bend * t_s * t_s / 2;
}

double SampleSmoothing::left_in(double from_s, double to_s) const {
  double sum = 0;
  int within = 0;
  for (std::size_t i = 0; i < left.size(); ++i) {
    if (time_s[i] < from_s || time_s[i] > to_s) continue;
    sum += left[i];
    ++within;
  }
  if (within > 0) return sum / within;
  // Between two samples: on the line through them.
  const auto after = std::ranges::lower_bound(time_s, from_s) - time_s.begin();
  if (left.empty() || after == 0 || after == std::ssize(time_s)) return 0;
  const auto b = static_cast<std::size_t>(after), a = b - 1;
  const double gone = ((from_s + to_s) / 2 - time_s[a]) / (time_s[b] - time_s[a]);
  return left[a] + gone * (left[b] - left[a]);
}

double SampleSmoothing::share(double from_s, double to_s) const {
  double sum = 0;
  for (std::size_t i = 0; i < slope_weights.size(); ++i) {
    sum += slope_weights[i] * std::clamp(time_s[i], from_s, to_s);
  }
  return sum;
}

SampleSmoothing smoothed(const std::vector<double>& time_s, const std::vector<double>& values) {
  SampleSmoothing result{
      .count = static_cast<int>(values.size()), .time_s = time_s, .left = {}, .slope_weights = {}};
  if (values.empty()) return result;
  const auto n = static_cast<Eigen::Index>(values.size());
  const Eigen::Index degree = n >= 5 ? 2 : n >= 3 ? 1 : 0;
  Eigen::MatrixXd design(n, degree + 1);
  Eigen::VectorXd y(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double t = time_s[static_cast<std::size_t>(i)];
    for (Eigen::Index k = 0; k <= degree; ++k) design(i, k) = std::pow(t, static_cast<double>(k));
    y[i] = values[static_cast<std::size_t>(i)];
  }
  const Eigen::MatrixXd normal = design.transpose() * design;
  const Eigen::LDLT<Eigen::MatrixXd> solver(normal);
  const Eigen::VectorXd c = solver.solve(design.transpose() * y);
  result.value = c[0];
  if (degree >= 1) result.slope = c[1];
  if (degree >= 2) result.bend = 2 * c[2];
  const Eigen::VectorXd left = y - design * c;
  result.left.assign(left.begin(), left.end());
  const Eigen::MatrixXd weights = solver.solve(design.transpose());
  result.value_by_sample = weights.row(0).norm();
  if (degree >= 1) {
    result.slope_weights.assign(weights.row(1).begin(), weights.row(1).end());
    result.slope_by_sample = weights.row(1).norm();
  }
  if (degree >= 1 && n > degree + 1) {
    const double variance = left.squaredNorm() / static_cast<double>(n - degree - 1);
    result.slope_std = std::sqrt(variance) * result.slope_by_sample;
  }
  return result;
}

}  // namespace regoplan
