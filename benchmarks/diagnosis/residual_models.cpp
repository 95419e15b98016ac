#include "benchmarks/diagnosis/residual_models.h"

#include <Eigen/Cholesky>
#include <array>
#include <cmath>
#include <limits>

namespace regoplan::challenge {
namespace {

constexpr double kMiddleLoad_n = 50;  // only differences of logarithms count

double angle(const FitRow& row, bool odd) {
  return odd ? row.slip_angle_rad : std::abs(row.slip_angle_rad);
}

Eigen::MatrixXd kernel(const std::vector<FitRow>& a, const std::vector<FitRow>& b, bool odd,
                       double scale) {
  Eigen::MatrixXd k(static_cast<Eigen::Index>(a.size()), static_cast<Eigen::Index>(b.size()));
  const double slip_length = 0.25 * scale, angle_length = 0.2 * scale, load_length = 0.7 * scale;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      const double s = (a[i].slip_ratio - b[j].slip_ratio) / slip_length;
      const double t = (angle(a[i], odd) - angle(b[j], odd)) / angle_length;
      const double l = std::log(a[i].load_n / b[j].load_n) / load_length;
      k(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          std::exp(-(s * s + t * t + l * l) / 2);
    }
  }
  return k;
}

Eigen::VectorXd library(const FitRow& row, bool odd) {
  const double s = row.slip_ratio, b = angle(row, odd), l = std::log(row.load_n / kMiddleLoad_n);
  Eigen::VectorXd terms(10);
  terms << 1, s, s * s, b, b * b, l, s * b, s * l, b * l, s * s * b;
  return terms;
}

}  // namespace

ResidualPrediction gaussian_process(const ResidualSample& sample,
                                    const std::vector<FitRow>& where) {
  const Eigen::Index n = sample.value.size();
  const Eigen::VectorXd variance = sample.sigma.array().square();
  const double nothing = -0.5 * (sample.value.array().square() / variance.array()).sum() -
                         0.5 * variance.array().log().sum();
  ResidualPrediction best{.value = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(where.size()))};
  const double typical = sample.sigma.mean();
  for (const double scale : {0.4, 0.8, 1.6}) {
    const Eigen::MatrixXd shape = kernel(sample.at, sample.at, sample.odd, scale);
    for (const double amplitude : {1.0, 2.0, 4.0, 8.0, 16.0, 32.0}) {
      const double power = std::pow(amplitude * typical, 2);
      Eigen::MatrixXd covariance = power * shape;
      covariance.diagonal() += variance;
      const Eigen::LLT<Eigen::MatrixXd> factor(covariance);
      const Eigen::VectorXd weights = factor.solve(sample.value);
      double log_det = 0;
      for (Eigen::Index i = 0; i < n; ++i) log_det += 2 * std::log(factor.matrixL()(i, i));
      const double gain = -0.5 * sample.value.dot(weights) - 0.5 * log_det - nothing;
      if (gain <= best.gain_nats) continue;
      best.gain_nats = gain;
      best.value = power * kernel(where, sample.at, sample.odd, scale) * weights;
    }
  }
  return best;
}

ResidualPrediction sparse_regression(const ResidualSample& sample,
                                     const std::vector<FitRow>& where) {
  const Eigen::Index n = sample.value.size();
  Eigen::MatrixXd all(n, 10);
  for (Eigen::Index i = 0; i < n; ++i) {
    all.row(i) = library(sample.at[static_cast<std::size_t>(i)], sample.odd) / sample.sigma[i];
  }
  const Eigen::VectorXd target = sample.value.array() / sample.sigma.array();
  std::vector<Eigen::Index> kept;
  for (Eigen::Index j = 0; j < all.cols(); ++j) kept.push_back(j);
  Eigen::VectorXd found;
  for (int pass = 0; pass < 10 && !kept.empty(); ++pass) {
    const Eigen::MatrixXd some = all(Eigen::all, kept);
    // a whisper of a ridge: terms that the design cannot tell apart share their part
    const Eigen::MatrixXd normal =
        some.transpose() * some +
        1e-8 * all.squaredNorm() / 10 * Eigen::MatrixXd::Identity(some.cols(), some.cols());
    const Eigen::MatrixXd inverse =
        normal.ldlt().solve(Eigen::MatrixXd::Identity(some.cols(), some.cols()));
    found = inverse * (some.transpose() * target);
    std::vector<Eigen::Index> next;
    for (std::size_t j = 0; j < kept.size(); ++j) {
      const auto index = static_cast<Eigen::Index>(j);
      if (std::abs(found[index]) > 3 * std::sqrt(inverse(index, index))) next.push_back(kept[j]);
    }
    if (next.size() == kept.size()) break;
    kept = next;
  }
  ResidualPrediction result{.value = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(where.size())),
                            .terms = static_cast<int>(kept.size())};
  if (kept.empty()) return result;
  for (std::size_t i = 0; i < where.size(); ++i) {
    result.value[static_cast<Eigen::Index>(i)] = library(where[i], sample.odd)(kept).dot(found);
  }
  return result;
}

}  // namespace regoplan::challenge
