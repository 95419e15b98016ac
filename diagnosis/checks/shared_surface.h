#pragma once

#include <Eigen/Core>
#include <stop_token>

#include "diagnosis/bed/discrepancy.h"

namespace regoplan {

/// What references say of the base model's shortcoming in one channel.
struct ShortcomingPoints {
  ConditionsAt at;
  Eigen::VectorXd residual;  ///< measured less predicted
  Eigen::MatrixXd noise;     ///< its covariance
  double scale = 0;          ///< of the channel: unit of a discrepancy's amplitude
};

/// A Gaussian process through such points, elsewhere.
struct SharedSurface {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
};

/// Under every setting of the discrepancy by its likelihood: the mean over them all, and their
/// spread. Where points are predicted by all others worse than is told, what lies between them
/// varies by as much more; what is measured is known as well as before. \throws Interrupted
SharedSurface surface_through(const ShortcomingPoints& points, Channel channel,
                              const ConditionsAt& wanted, const std::stop_token& stop);

}  // namespace regoplan
