#pragma once

#include <cstdint>
#include <vector>

#include "diagnosis/names/calibrated_recording.h"

namespace regoplan {

/// Residuals of the base model, a column each, where its soil would be as beforehand: linear about
/// the base fit.
Eigen::MatrixXd beforehand(const CandidateFit& base, const Eigen::MatrixXd& residuals);

/// A misfit without a name: a smooth surface over the conditions on each channel, as large as it
/// need be; or sinkages without a law that the forces follow, beside a capped surface. One is as
/// likely beforehand as the other.
class NamelessMisfit {
 public:
  /// \param settings of the surfaces that the recording calls for, by channel
  /// \param capped weights of the surface beside sinkages
  NamelessMisfit(const CalibratedRecording& calibrated, std::vector<std::size_t> settings,
                 const SettingWeights& capped);

  /// Of every residual of the base model.
  /// \param residuals beforehand(), whitened under all settings
  std::vector<double> log_evidence(const WhitenedResiduals& residuals) const;

  /// Residuals of the base model at its fit, a column each, in worlds with noise whose misfit has
  /// no name: in turn surfaces as large as the recording's, as smooth and smoother, and sinkages.
  Eigen::MatrixXd worlds(std::uint64_t seed) const;

 private:
  /// By kSinkageSpreads, one a column, of every residual.
  Eigen::MatrixXd sinking_nats(const WhitenedResiduals& residuals) const;

  const CalibratedRecording& calibrated_;
  std::vector<std::size_t> settings_;
  SettingWeights capped_;
  Eigen::MatrixXd sinkage_columns_;  // for a spread of 1
  double sinkage_spread_ = 0;        // the likeliest of the recording
};

}  // namespace regoplan
