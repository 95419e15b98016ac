#pragma once

#include "diagnosis/bed/condensed_recording.h"
#include "diagnosis/fit/calibration.h"
#include "diagnosis/fit/candidate_fit.h"
#include "synthetic_bed.h"

namespace regoplan {

/// A recording condensed, its soil numbers calibrated: what later steps of a diagnosis build on.
struct CalibratedBed {
  CondensedRecording recording;
  std::vector<SoilCoordinate> soil;
  CandidateFit fit;
  Discrepancy discrepancy;
  Eigen::MatrixXd soil_free;

  explicit CalibratedBed(const Recording& raw, const DiagnosisSetup& setup = simulant_setup())
      : recording(condense(raw, setup)),
        soil(soil_coordinates(setup.soil)),
        discrepancy(recording.bed) {
    const Calibration found = calibrate(recording.bed, soil);
    fit.x = found.x;
    fit.prediction = found.prediction;
    fit.jacobian = found.jacobian;
    fit.evidence.covariance = found.covariance;
    fit.evidence.settings.assign(recording.bed.channels.size(), 0);
    soil_free = soil_directions(recording.bed, fit.jacobian);
  }

  FitProblem problem() const { return {recording.bed, soil, discrepancy, soil_free}; }
};

}  // namespace regoplan
