#pragma once

#include <Eigen/Cholesky>
#include <vector>

#include "diagnosis/recording/noise_model.h"
#include "diagnosis/recording/replicates.h"

namespace regoplan {

/// What replicates of one channel say of a trend, the noise model's parts held at those of a
/// channel's plain noise, what days differ by at no more than is usual, or given up for the trend.
class ReplicateContrasts {
 public:
  ReplicateContrasts(const Recording& recording, const std::vector<Condition>& conditions,
                     const std::vector<double>& adjusted, const ChannelNoise& plain);

  /// Log likelihood that letting the runs follow a column adds, by what it would be among so many
  /// replicates that their scatter is known: of few, chance follows any column far. \param trend
  /// per run
  double gain(const std::vector<double>& trend) const;

 private:
  struct Covariance {
    Eigen::LLT<Eigen::MatrixXd> factor;
    double score = 0;  // without the trend's part
  };
  double score(const Covariance& covariance, double misfit) const;

  ReplicateRows rows_;
  Eigen::VectorXd e_;  // contrasts of what was measured
  std::vector<Covariance> covariances_;
};

}  // namespace regoplan
