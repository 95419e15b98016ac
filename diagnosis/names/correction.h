#pragma once

#include <string>
#include <vector>

#include "diagnosis/findings/findings.h"
#include "diagnosis/fit/scoring.h"
#include "diagnosis/names/calibrated_recording.h"

namespace regoplan {

/// A corrected model as it is handed out, and what it leaves of the recording.
struct Correction {
  WheelModelSpec model;
  UncertainSoil soil;
  std::vector<SoilPull> soil_pulls;
  HeldOut proof;
  FitRemainder remainder;       ///< on the conditions it was fitted to
  bool adds_remainder = false;  ///< the mean of a discrepancy is part of it
  std::vector<RunResidual> residuals;
  std::string carried;  ///< where its correction without a name stands; empty: nothing else varies
  std::string
      refused;  ///< why the model asked for gave way to the calibrated one; empty: it did not
  std::string despite;  ///< what speaks against the model asked for, and why it stands all the same
};

/// Why a calibrated model is not handed on; empty where it is: soil numbers that fit some channels
/// at the cost of another tell nothing of the soil.
/// \param proof of the calibrated model
std::string worse_than_prior_means(const CalibratedRecording& calibrated, const HeldOut& proof);

/// The calibrated model, nothing added, or the prior means where it spoils what these predict.
/// \param proof of the calibrated model
Correction calibrated_alone(const CalibratedRecording& calibrated, const HeldOut& proof,
                            int threads);

/// A fitted candidate with the remainder added to it (settings of the discrepancy; empty: none), or
/// the calibrated model where that does as well on held-out conditions. Calibrated soil that lies
/// farther from its tests than soils lie gives way to a candidate beside which it does not.
/// \param proof of that candidate and that remainder
Correction correction_by(const CalibratedRecording& calibrated, const CandidateFit& fit,
                         const std::vector<std::size_t>& remainder, const HeldOut& proof,
                         int threads);

/// A surface over the calibrated soil, or over the soil that a discrepancy leaves to be found: the
/// one that does better on held-out conditions.
Correction correction_without_name(const CalibratedRecording& calibrated,
                                   const std::vector<ScoredId>& scored, int threads);

}  // namespace regoplan
