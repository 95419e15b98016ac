#include "diagnosis/recording/replicate_covariance.h"

namespace regoplan {

ReplicateCovariance::ReplicateCovariance(const ReplicateRows& rows,
                                         const Eigen::VectorXd& own_variance,
                                         const Eigen::MatrixXd& shared)
    : group_(rows.group), precision_(own_variance.cwiseInverse()) {
  precision_of_group_.setZero(rows.groups);
  Eigen::VectorXd runs = Eigen::VectorXd::Zero(rows.groups);
  for (Eigen::Index i = 0; i < precision_.size(); ++i) {
    const Eigen::Index group = group_[static_cast<std::size_t>(i)];
    precision_of_group_[group] += precision_[i];
    runs[group] += 1;
  }
  shared_ = whitened(shared);
  among_shared_ = shared_.transpose() * shared_;
  own_log_determinant_ = own_variance.array().log().sum() +
                         precision_of_group_.array().log().sum() - runs.array().log().sum();
  share(Eigen::VectorXd::Ones(shared.cols()));
}

void ReplicateCovariance::share(const Eigen::VectorXd& deviations) {
  deviations_ = deviations;
  // Woodbury: the inverse of a diagonal with few columns beside it.
  Eigen::MatrixXd among = deviations.asDiagonal() * among_shared_ * deviations.asDiagonal();
  among.diagonal().array() += 1;
  factor_.compute(among);
}

double ReplicateCovariance::log_determinant() const {
  return own_log_determinant_ + 2 * factor_.matrixLLT().diagonal().array().log().sum();
}

double ReplicateCovariance::own_share() const {
  const Eigen::Index count = shared_.cols();
  const auto contrasts = static_cast<double>(precision_.size() - precision_of_group_.size());
  return contrasts - static_cast<double>(count) +
         factor_.solve(Eigen::MatrixXd::Identity(count, count)).trace();
}

Eigen::MatrixXd ReplicateCovariance::whitened(Eigen::MatrixXd columns) const {
  Eigen::MatrixXd mean = Eigen::MatrixXd::Zero(precision_of_group_.size(), columns.cols());
  for (Eigen::Index i = 0; i < columns.rows(); ++i) {
    const Eigen::Index group = group_[static_cast<std::size_t>(i)];
    mean.row(group) += precision_[i] / precision_of_group_[group] * columns.row(i);
  }
  for (Eigen::Index i = 0; i < columns.rows(); ++i) {
    columns.row(i) -= mean.row(group_[static_cast<std::size_t>(i)]);
  }
  return precision_.cwiseSqrt().asDiagonal() * columns;
}

ReplicateCovariance::Differences ReplicateCovariance::differences(
    const Eigen::MatrixXd& columns) const {
  Differences differences{.own = whitened(columns), .along = {}};
  differences.along = shared_.transpose() * differences.own;
  return differences;
}

Eigen::MatrixXd ReplicateCovariance::products(const Differences& columns) const {
  const Eigen::MatrixXd along = deviations_.asDiagonal() * columns.along;
  return columns.own.transpose() * columns.own - along.transpose() * factor_.solve(along);
}

}  // namespace regoplan
