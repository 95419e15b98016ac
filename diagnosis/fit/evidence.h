#pragma once

#include <Eigen/Core>
#include <vector>

#include "diagnosis/bed/discrepancy.h"

namespace regoplan {

/// Log prior weights over discrepancy_settings(), the same for every channel.
struct SettingWeights {
  std::vector<double> log_weight;
  /// Largest amplitude that counts, per channel; empty: all count.
  std::vector<double> most_amplitude = {};

  bool excludes(std::size_t channel, std::size_t setting) const;

  static SettingWeights of_named();        ///< small discrepancies likelier, large ones possible
  static SettingWeights of_none();         ///< at most one run's noise
  static SettingWeights of_unexplained();  ///< any, small or large
  /// Every amplitude up to the cap of its channel alike.
  static SettingWeights up_to(std::vector<double> most_amplitude);
};

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

}  // namespace regoplan
