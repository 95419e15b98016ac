#include "diagnosis/recording/replicate_contrasts.h"

#include <algorithm>
#include <cmath>

#include "diagnosis/recording/thresholds.h"

namespace regoplan {
namespace {

/// The share of a gain by one factor in the likelihood of `count` contrasts, their scatter
/// estimated along, that it is worth where the scatter is known: the square of the normal deviate
/// of Student's t over n log(1 + t^2/(n - 1)) (Wallace 1959, Ann. Math. Statist. 30, 1124; within 2
/// % of the deviate from 3 degrees of freedom on).
double worth_of_gain(double count) {
  const double freedom = count - 1;
  if (freedom < 1) return 0;
  return freedom / count * std::pow((8 * freedom + 1) / (8 * freedom + 3), 2);
}

}  // namespace

ReplicateContrasts::ReplicateContrasts(const Recording& recording,
                                       const std::vector<Condition>& conditions,
                                       const std::vector<double>& adjusted,
                                       const ChannelNoise& plain) {
  rows_ = rows_of(recording, replicates_of(conditions, adjusted), adjusted);
  const Eigen::VectorXd& signal = rows_.signal;
  const Eigen::MatrixXd& contrasts = rows_.contrasts;
  const Eigen::VectorXd weight = rows_.of(plain.weight);
  Eigen::VectorXd own(signal.size());
  for (Eigen::Index i = 0; i < own.size(); ++i) {
    own[i] = std::pow(run_deviation(plain, signal[i]), 2) / weight[i];
  }
  e_ = contrasts * rows_.value;
  const Eigen::MatrixXd within = contrasts * own.asDiagonal() * contrasts.transpose();
  // By more than days usually do they differ for a reason, which a column may tell. Of signals that
  // are much alike, an offset passes for a share of the signal.
  const double usual = usual_deviation(plain, {signal.begin(), signal.end()});
  const double size = std::sqrt(signal.squaredNorm() / static_cast<double>(signal.size()));
  const double gain = std::min(plain.day_gain, Thresholds::kUsualDay_share);
  const double beyond = (std::pow(plain.day_gain, 2) - gain * gain) * size * size;
  const double offset = std::min(std::sqrt(std::pow(plain.day_offset, 2) + beyond),
                                 Thresholds::kUsualDay_deviations * usual);
  const Eigen::MatrixXd of_days =
      (offset * offset + gain * gain * (signal * signal.transpose()).array()) *
      rows_.same_day.array();
  const Eigen::MatrixXd days = contrasts * of_days * contrasts.transpose();
  const bool has_days = !plain.day_assumed && plain.day_offset + plain.day_gain > 0;
  for (const bool with_days : {true, false}) {
    if (with_days && !has_days) continue;
    Covariance& at = covariances_.emplace_back();
    at.factor.compute(with_days ? Eigen::MatrixXd(within + days) : within);
    at.score = score(at, e_.dot(at.factor.solve(e_)));
  }
}

double ReplicateContrasts::score(const Covariance& covariance, double misfit) const {
  const auto m = static_cast<double>(e_.size());
  const double log_det = 2 * covariance.factor.matrixLLT().diagonal().array().log().sum();
  return -0.5 * (m * std::log(misfit / m) + log_det);
}

double ReplicateContrasts::gain(const std::vector<double>& trend) const {
  constexpr double kRounding = 1e-9;
  const Eigen::VectorXd followed = rows_.of(trend), column = rows_.contrasts * followed;
  if (column.norm() <= kRounding * followed.norm()) return 0;  // alike for all replicates
  double before = -INFINITY, after = -INFINITY;
  for (const Covariance& covariance : covariances_) {
    const Eigen::VectorXd solved = covariance.factor.solve(column);
    const double weight = column.dot(solved);
    if (!(weight > 0)) continue;
    const double misfit =
        e_.dot(covariance.factor.solve(e_)) - std::pow(e_.dot(solved), 2) / weight;
    before = std::max(before, covariance.score);
    after = std::max(after, score(covariance, misfit));
  }
  if (!std::isfinite(after)) return 0;
  return worth_of_gain(static_cast<double>(e_.size())) * (after - before);
}

}  // namespace regoplan
