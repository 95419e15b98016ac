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

/// Whether a column says the same of all replicates of each condition, but for rounding.
bool is_alike_in_groups(const ReplicateRows& rows, const Eigen::VectorXd& column) {
  const double rounding = 1e-9 * column.norm();
  for (Eigen::Index i = 1; i < column.size(); ++i) {
    const auto row = static_cast<std::size_t>(i);
    const bool together = rows.group[row] == rows.group[row - 1];
    if (together && std::abs(column[i] - column[i - 1]) > rounding) return false;
  }
  return true;
}

}  // namespace

ReplicateContrasts::ReplicateContrasts(const Recording& recording,
                                       const std::vector<Condition>& conditions,
                                       const std::vector<double>& adjusted,
                                       const ChannelNoise& plain) {
  rows_ = rows_of(recording, replicates_of(conditions, adjusted), adjusted);
  const Eigen::VectorXd& signal = rows_.signal;
  const Eigen::VectorXd weight = rows_.of(plain.weight);
  Eigen::VectorXd own(signal.size());
  for (Eigen::Index i = 0; i < own.size(); ++i) {
    own[i] = std::pow(run_deviation(plain, signal[i]), 2) / weight[i];
  }
  // By more than days usually do they differ for a reason, which a column may tell. Of signals that
  // are much alike, an offset passes for a share of the signal.
  const double usual = usual_deviation(plain, {signal.begin(), signal.end()});
  const double size = std::sqrt(signal.squaredNorm() / static_cast<double>(signal.size()));
  const double gain = std::min(plain.day_gain, Thresholds::kUsualDay_share);
  const double beyond = (std::pow(plain.day_gain, 2) - gain * gain) * size * size;
  const double offset = std::min(std::sqrt(std::pow(plain.day_offset, 2) + beyond),
                                 Thresholds::kUsualDay_deviations * usual);
  Eigen::MatrixXd of_days(signal.size(), 2 * rows_.of_day.cols());
  of_days << offset * rows_.of_day, gain * (signal.asDiagonal() * rows_.of_day);
  if (!plain.day_assumed && plain.day_offset + plain.day_gain > 0) {
    covariances_.emplace_back(rows_, own, of_days);
  }
  covariances_.emplace_back(rows_, own, Eigen::MatrixXd(signal.size(), 0));
}

double ReplicateContrasts::score(const ReplicateCovariance& covariance, double misfit) const {
  const auto m = static_cast<double>(rows_.contrasts());
  return -0.5 * (m * std::log(misfit / m) + covariance.log_determinant());
}

double ReplicateContrasts::gain(const std::vector<double>& trend) const {
  Eigen::MatrixXd columns(rows_.value.size(), 2);
  columns << rows_.value, rows_.of(trend);
  if (is_alike_in_groups(rows_, columns.col(1))) return 0;
  double before = -INFINITY, after = -INFINITY;
  for (const ReplicateCovariance& covariance : covariances_) {
    const Eigen::MatrixXd products = covariance.products(covariance.differences(columns));
    const double misfit = products(0, 0), along = products(0, 1), weight = products(1, 1);
    if (!(weight > 0)) continue;
    before = std::max(before, score(covariance, misfit));
    after = std::max(after, score(covariance, misfit - along * along / weight));
  }
  if (!std::isfinite(after)) return 0;
  return worth_of_gain(static_cast<double>(rows_.contrasts())) * (after - before);
}

}  // namespace regoplan
