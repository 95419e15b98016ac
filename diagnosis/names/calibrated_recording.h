#pragma once

#include <vector>

#include "diagnosis/bed/condensed_recording.h"
#include "diagnosis/checks/detection.h"
#include "diagnosis/findings/findings.h"
#include "diagnosis/fit/candidate_fit.h"
#include "diagnosis/fit/held_out.h"

namespace regoplan {

/// A recording with the soil fitted to it and nothing else: what all that may be wrong is held
/// against. Neither copied nor moved: fit problems point into it.
class CalibratedRecording {
 public:
  /// \throws InputError as condense() and calibrate()
  CalibratedRecording(const Recording& recording, const DiagnosisSetup& setup,
                      std::stop_token stop = {});
  /// Of runs condensed already; soil numbers without prior deviation stay as they are.
  explicit CalibratedRecording(CondensedRecording condensed);
  CalibratedRecording(const CalibratedRecording&) = delete;
  CalibratedRecording& operator=(const CalibratedRecording&) = delete;

  const CondensedRecording& recording() const { return recording_; }
  const TestBed& bed() const { return recording_.bed; }
  const std::vector<SoilCoordinate>& soil() const { return soil_; }
  const Discrepancy& discrepancy() const { return discrepancy_; }
  /// The calibrated model, without effects and discrepancy.
  const CandidateFit& base() const { return base_; }

  /// What was measured less what it predicts, over all channels.
  Eigen::VectorXd residual() const { return bed().measured() - base_.prediction; }

  FitProblem problem() const { return {bed(), soil_, discrepancy_, soil_free_}; }
  /// The soil's priors widened kWideSoil times, for the verdict `parameters`.
  FitProblem wide_problem() const { return {bed(), wide_soil_, discrepancy_, soil_free_}; }
  static constexpr double kWideSoil = 3;

  Eigen::VectorXd prediction_at_prior_means() const;
  FitRemainder remainder_of(const CandidateFit& fit) const;
  /// What was measured against the soil of a fit, without the effects that it was fitted beside.
  /// That soil is as uncertain as the fit leaves it; that it follows the noise is not counted, so
  /// its deviations are no smaller than they are.
  FitRemainder off_soil_beside(const CandidateFit& fit) const;

  /// Whether calibrated soil numbers gain more over their prior means, the pulls on them counted,
  /// than numbers that are free within their priors gain of noise: by two standard deviations.
  bool soil_explains_something() const;

  /// A fitted soil number in its file's unit.
  Estimate soil_estimate(const CandidateFit& fit, std::size_t number) const;
  /// What calibration made of every soil number.
  std::vector<SoilPull> soil_pulls() const;

  /// By the kind of families that the recording has most of.
  HeldOut held_out(const CorrectedModel& corrected, int threads) const;
  HeldOut held_out(const CorrectedModel& corrected, const Families& families, int threads) const;

 private:
  CondensedRecording recording_;
  std::vector<SoilCoordinate> soil_, wide_soil_;
  Discrepancy discrepancy_;
  Eigen::MatrixXd soil_free_;
  CandidateFit base_;
};

}  // namespace regoplan
