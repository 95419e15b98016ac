#pragma once

#include <Eigen/Core>
#include <vector>

#include "diagnosis/bed/discrepancy.h"
#include "diagnosis/fit/setting_weights.h"

namespace regoplan {

/// A linear model of the data: measured - prediction(0) = jacobian x + discrepancy + noise.
struct Linearised {
  Eigen::VectorXd residual;  ///< at x = 0
  Eigen::MatrixXd jacobian;
};

/// The strong directions of the soil numbers in the data: what a discrepancy must leave to them.
/// \return one column a direction, normalised so that noise along it has unit variance
Eigen::MatrixXd soil_directions(const TestBed& bed, const Eigen::MatrixXd& soil_jacobian);

struct Evidence {
  double log_marginal = 0;            ///< x and the settings of the discrepancy marginalised
  std::vector<std::size_t> settings;  ///< the likeliest, per channel
  Eigen::VectorXd x;                  ///< posterior mean under these
  Eigen::MatrixXd covariance;         ///< of x
};

/// Posterior mean of x under given settings of the discrepancy, and its precision.
struct Posterior {
  Eigen::VectorXd x;
  Eigen::MatrixXd precision;
};

Posterior posterior_of(const TestBed& bed, const Discrepancy& discrepancy, const Linearised& linear,
                       const std::vector<std::size_t>& settings);

/// Residual quadratic form under given settings.
double misfit_of(const TestBed& bed, const Discrepancy& discrepancy,
                 const Eigen::VectorXd& residual, const std::vector<std::size_t>& settings);

/// Orthonormal-like functions of the conditions whose standard normal mixtures are smooth random
/// functions of unit variance. \return conditions x functions
Eigen::MatrixXd smooth_functions(const TestBed& bed);

/// Log marginal likelihood of a linear model with x standard normal beforehand.
/// \param soil_free the soil's directions (soil_directions), of which the discrepancy keeps clear
Evidence evidence_of(const TestBed& bed, const Discrepancy& discrepancy, const Linearised& linear,
                     const Eigen::MatrixXd& soil_free, const SettingWeights& weights);

/// Residuals of one bed, a column each, whitened under every setting that counts.
class WhitenedResiduals {
 public:
  WhitenedResiduals(const TestBed& bed, const Discrepancy& discrepancy,
                    const Eigen::MatrixXd& residuals, const SettingWeights& weights);

  const Eigen::MatrixXd& at(std::size_t channel, std::size_t setting) const {
    return at_[channel][setting];
  }
  std::size_t count() const { return count_; }

 private:
  std::vector<std::vector<Eigen::MatrixXd>> at_;
  std::size_t count_;
};

/// The same of many residuals under one model, whose columns are worked out once for all of them.
/// \param residuals whitened under all settings that have a weight
std::vector<Evidence> evidence_of(const TestBed& bed, const Discrepancy& discrepancy,
                                  const WhitenedResiduals& residuals,
                                  const Eigen::MatrixXd& jacobian, const Eigen::MatrixXd& soil_free,
                                  const SettingWeights& weights);

}  // namespace regoplan
