#pragma once

#include <cstdint>
#include <vector>

#include "diagnosis/names/calibrated_recording.h"

namespace regoplan {

/// A residual of the base model, linear in the soil about the base fit.
Linearised linear_at(const CandidateFit& base, const Eigen::VectorXd& residual);

/// A misfit without a name: a smooth surface over the conditions on each channel, as large as it
/// need be; or sinkages without a law that the forces follow, beside a capped surface. One is as
/// likely beforehand as the other.
class NamelessMisfit {
 public:
  /// \param settings of the surfaces that the recording calls for, by channel
  /// \param capped weights of the surface beside sinkages
  NamelessMisfit(const CalibratedRecording& calibrated, std::vector<std::size_t> settings,
                 const SettingWeights& capped);

  /// Of a residual of the base model at its fit.
  double log_evidence(const Eigen::VectorXd& residual) const;

  /// Residuals of worlds with noise whose misfit has no name: in turn surfaces as large as the
  /// recording's, as smooth and smoother, and sinkages.
  std::vector<Eigen::VectorXd> worlds(std::uint64_t seed) const;

 private:
  std::vector<double> sinking_nats(const Eigen::VectorXd& residual) const;  // by kSinkageSpreads

  const CalibratedRecording& calibrated_;
  std::vector<std::size_t> settings_;
  SettingWeights capped_;
  Eigen::MatrixXd sinkage_columns_;  // for a spread of 1
  double sinkage_spread_ = 0;        // the likeliest of the recording
};

}  // namespace regoplan
