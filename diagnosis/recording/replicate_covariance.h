#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

#include "diagnosis/recording/replicates.h"

namespace regoplan {

/// Covariance of the differences between replicates, where each run has a variance of its own and
/// runs share what some columns say: those of the restricted likelihood (Patterson & Thompson 1971,
/// Biometrika 58, 545). It is a diagonal within groups and of low rank beside it, so that nothing
/// is made as large as runs x runs.
class ReplicateCovariance {
 public:
  /// \param own_variance of each row \param shared rows x columns, each by one deviation of what
  /// its runs share
  ReplicateCovariance(const ReplicateRows& rows, const Eigen::VectorXd& own_variance,
                      const Eigen::MatrixXd& shared);

  /// From now on runs share so many deviations of each column.
  void share(const Eigen::VectorXd& deviations);

  /// Columns' differences between replicates, as products take them, whatever runs share.
  struct Differences {
    Eigen::MatrixXd own;    ///< by the runs' own deviations
    Eigen::MatrixXd along;  ///< inner products with the shared columns
  };
  Differences differences(const Eigen::MatrixXd& columns) const;

  /// Inner products of columns' differences under the inverse of the covariance.
  Eigen::MatrixXd products(const Differences& columns) const;
  double log_determinant() const;
  /// Trace of the runs' own part in it: the degrees of freedom that tell their own scatter.
  double own_share() const;

 private:
  /// Less the mean of its group, by its own deviation.
  Eigen::MatrixXd whitened(Eigen::MatrixXd columns) const;

  std::vector<Eigen::Index> group_;                 // of each row
  Eigen::VectorXd precision_, precision_of_group_;  // of each row, and of all of a group
  double own_log_determinant_ = 0;
  Eigen::MatrixXd shared_, among_shared_;  // whitened, and its inner products
  Eigen::VectorXd deviations_;
  Eigen::LLT<Eigen::MatrixXd> factor_;
};

}  // namespace regoplan
