#include "diagnosis/model_of_test.h"

#include <algorithm>

#include "diagnosis/fit/unnamed_correction.h"

namespace regoplan {
namespace {

/// The test as it was measured: what it shares with its references put back.
CondensedRecording as_measured(CondensedRecording recording, const MeasuredTest& measured) {
  TestBed& bed = recording.bed;
  for (std::size_t c = 0; c < bed.channels.size(); ++c) {
    ChannelData& data = bed.channels[c];
    const Eigen::Index from = bed.offset(c), n = data.mean.size();
    data.mean = measured.mean.segment(from, n);
    data.noise = measured.noise_variance.segment(from, n).asDiagonal();
    for (Eigen::Index i = 0; i < n; ++i) {
      const std::size_t k = data.conditions[static_cast<std::size_t>(i)];
      for (const std::size_t run : bed.conditions[k].runs) {
        recording.adjusted[c][run] += measured.shared[from + i];
      }
    }
  }
  return recording;
}

/// What the test was measured to be on held-out conditions, by the effects, what the references
/// share and what the other conditions leave of the difference. Of the last two together counts
/// what proves itself, per channel.
HeldOut hold_out_with_shared(const CalibratedRecording& difference, const MeasuredTest& measured,
                             const CandidateFit& fit, const HeldOut& by_effects, int threads) {
  const CandidateFit* effects = fit.candidate.effects.empty() ? nullptr : &fit;
  const CorrectedModel model{.fit = effects,
                             .remainder = remainder_settings(difference.problem(), fit)};
  HeldOut result = difference.held_out(model, by_effects.families, threads);
  const Eigen::VectorXd unnamed = measured.shared + result.corrected - by_effects.corrected,
                        left = measured.mean - by_effects.corrected;
  result.corrected = by_effects.corrected;
  const TestBed& bed = difference.bed();
  for (std::size_t c = 0; c < bed.channels.size(); ++c) {
    const Eigen::Index from = bed.offset(c), n = bed.channels[c].mean.size();
    const Eigen::VectorXd part = unnamed.segment(from, n);
    const Eigen::VectorXd weighted = part.cwiseQuotient(measured.noise_variance.segment(from, n));
    const double square = weighted.dot(part);
    const double share =
        square > 0 ? std::clamp(weighted.dot(left.segment(from, n)) / square, 0.0, 1.0) : 0;
    result.remainder_share[c] = share;
    result.corrected.segment(from, n) += share * part;
  }
  return result;
}

}  // namespace

Correction model_of_test(const CalibratedRecording& difference, const MeasuredTest& measured,
                         const CandidateFit& fit, const HeldOut& proof, int threads) {
  const CalibratedRecording test(as_measured(difference.recording(), measured));
  return correction_by(test, fit, remainder_settings(test.problem(), fit),
                       hold_out_with_shared(difference, measured, fit, proof, threads), threads);
}

}  // namespace regoplan
