#include "diagnosis/recording/replicate_covariance.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

namespace regoplan {
namespace {

/// Nine runs of three conditions, on two days.
ReplicateRows nine_runs() {
  ReplicateRows rows{.group = {0, 0, 0, 0, 1, 1, 2, 2, 2}, .groups = 3};
  rows.value.resize(9);
  rows.value << 3, 4.5, 2, 3.3, 9, 7.5, -1, 0.4, -2;
  rows.of_day.resize(9, 2);
  rows.of_day << 1, 0, 1, 0, 0, 1, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 0, 1;
  return rows;
}

/// Orthonormal differences within the groups, one a row (Helmert).
Eigen::MatrixXd differences() {
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(6, 9);
  Eigen::Index row = 0, from = 0;
  for (const Eigen::Index size : {4, 2, 3}) {
    for (Eigen::Index i = 1; i < size; ++i, ++row) {
      const auto n = static_cast<double>(i);
      all.row(row).segment(from, i).setConstant(1 / std::sqrt(n * (n + 1)));
      all(row, from + i) = -n / std::sqrt(n * (n + 1));
    }
    from += size;
  }
  return all;
}

TEST(ReplicateCovariance, IsThatOfTheDifferencesWithinGroups) {
  const ReplicateRows rows = nine_runs();
  Eigen::VectorXd own(9), trend(9);
  own << 1, 2, 0.5, 1, 4, 1, 1, 0.3, 1;
  trend << 0, 1, 2, 3, 4, 5, 6, 7, 8.5;
  Eigen::MatrixXd columns(9, 2);
  columns << rows.value, trend;
  ReplicateCovariance covariance(rows, own, rows.of_day);
  const ReplicateCovariance::Differences told = covariance.differences(columns);
  for (const double deviation : {1.0, 0.7, 0.0}) {
    covariance.share(Eigen::VectorXd::Constant(2, deviation));
    const Eigen::MatrixXd within = differences() * own.asDiagonal() * differences().transpose();
    const Eigen::MatrixXd days = differences() * rows.of_day;
    const Eigen::MatrixXd whole = within + deviation * deviation * days * days.transpose();
    const Eigen::MatrixXd dense = differences() * columns;
    const Eigen::MatrixXd products = dense.transpose() * whole.inverse() * dense;
    EXPECT_NEAR(covariance.log_determinant(), std::log(whole.determinant()), 1e-12);
    EXPECT_TRUE(covariance.products(told).isApprox(products, 1e-12));
    EXPECT_NEAR(covariance.own_share(), (whole.inverse() * within).trace(), 1e-12);
  }
}

}  // namespace
}  // namespace regoplan
