#pragma once

#include <Eigen/Core>
#include <vector>

#include "diagnosis/bed/wheel_bed.h"
#include "diagnosis/fit/coordinate.h"

namespace regoplan {

/// The soil numbers that fit best, priors from independent soil tests counted as data.
struct Calibration {
  Eigen::VectorXd x;           ///< in prior standard deviations from the prior mean
  Eigen::VectorXd prediction;  ///< at x
  Eigen::MatrixXd jacobian;    ///< by x
  Eigen::MatrixXd covariance;  ///< of x
};

/// Maximum a posteriori by Ceres (Levenberg-Marquardt, bounds at the valid ranges, derivatives by
/// central differences) under the noise alone.
/// \throws InputError where the model has no forces at the prior means
Calibration calibrate(const TestBed& bed, const std::vector<SoilCoordinate>& soil);

}  // namespace regoplan
