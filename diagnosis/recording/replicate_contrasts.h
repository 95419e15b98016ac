#pragma once

#include <Eigen/Core>
#include <vector>

#include "diagnosis/recording/noise_model.h"
#include "diagnosis/recording/replicate_covariance.h"
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
  double score(const ReplicateCovariance& covariance, double misfit) const;

  ReplicateRows rows_;
  std::vector<ReplicateCovariance> covariances_;  ///< with what days differ by, and without
};

}  // namespace regoplan
