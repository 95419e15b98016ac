#pragma once

#include <vector>

#include "diagnosis/findings/findings.h"
#include "diagnosis/names/calibrated_recording.h"
#include "diagnosis/recording/thresholds.h"

namespace regoplan {

/// What a fitted candidate alone, no remainder added, explains of the excess misfit on held-out
/// conditions: by the kind of families there are most of, and the range over all kinds that have a
/// clear excess; nothing by none.
struct NameShare {
  Share share;
  bool is_told = false;  ///< whether any kind has a clear excess
  std::string held_out_by;
  double gain_in_errors = 0;  ///< least over the kinds of families
  /// Of the channel that it predicts worst beside without it, in the mean over the kinds of
  /// families; below 0 where none gets worse.
  ChannelLoss loss;

  bool worsens(double errors = Thresholds::kClear_errors) const { return loss.errors > errors; }
};

/// Names fitted as if there was nothing beside them: a discrepancy takes part of what they do.
CandidateFit fitted_alone(const CalibratedRecording& calibrated, const CandidateFit& fit);

NameShare name_share(const CalibratedRecording& calibrated, const CandidateFit& fit, int threads);

/// As much for the effect that a fit has more than another has.
NameShare added_share(const CalibratedRecording& calibrated, const CandidateFit& with,
                      const CandidateFit& without, int threads);

/// Whether names with a remainder predict the outermost families better than the remainder alone,
/// which must extrapolate there. \param by_surface settings of the remainder on the base model
bool extrapolates_better(const CalibratedRecording& calibrated, const CandidateFit& fit,
                         const std::vector<std::size_t>& by_surface, int threads);

}  // namespace regoplan
