#pragma once

#include <Eigen/Core>
#include <vector>

#include "benchmarks/diagnosis/soil_fit.h"

namespace regoplan::challenge {

/// Residuals of one channel at some conditions, whitened apart.
struct ResidualSample {
  std::vector<FitRow> at;
  Eigen::VectorXd value, sigma;
  bool odd = false;  ///< changes its sign with the slip angle
};

/// What was learned from residuals, at other conditions.
struct ResidualPrediction {
  Eigen::VectorXd value;
  double gain_nats = 0;  ///< evidence over no residual model (Gaussian process)
  int terms = 0;         ///< that survived (sparse regression)
};

/// Gaussian process with a squared exponential kernel over slip, slip angle and log load; amplitude
/// and lengths by evidence on a grid.
ResidualPrediction gaussian_process(const ResidualSample& sample, const std::vector<FitRow>& where);

/// Least squares on 1, s, s^2, b, b^2, l, s b, s l, b l, s^2 b (s slip, b slip angle, l log load),
/// in turn without the terms below 3 standard errors.
ResidualPrediction sparse_regression(const ResidualSample& sample,
                                     const std::vector<FitRow>& where);

}  // namespace regoplan::challenge
