#include "diagnosis/model_of_test.h"

#include <algorithm>

#include "diagnosis/fit/carried_surface.h"
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

/// How far the references pulled the soil from what independent tests tell of it.
std::vector<SoilPull> pulls_by_references(const MeasuredTest& measured) {
  const auto& [before, after] = std::pair(measured.tested_soil, measured.soil);
  std::vector<SoilPull> pulls;
  for (const SoilParameter& p : soil_parameters()) {
    const double spread = before.standard_deviation.*p.member, unit = p.file_unit;
    if (spread == 0) continue;
    const Estimate known{after.mean.*p.member / unit, after.standard_deviation.*p.member / unit};
    const double pull = (after.mean.*p.member - before.mean.*p.member) / spread;
    pulls.push_back({.parameter = std::string(p.name),
                     .prior = {before.mean.*p.member / unit, spread / unit},
                     .calibrated = known,
                     .corrected = known,
                     .pull = pull,
                     .corrected_pull = pull});
  }
  return pulls;
}

/// What both share as far as a model file carries it: what it does with pass, speed or time is
/// lost.
Eigen::VectorXd carried_of_shared(const CalibratedRecording& test,
                                  const std::vector<std::size_t>& settings,
                                  const Eigen::VectorXd& shared) {
  const TestBed& bed = test.bed();
  Eigen::VectorXd carried = shared;
  if (!varies_beyond_a_model_file(bed)) return carried;
  const CarriedAt place = CarriedAt::of(bed);
  for (std::size_t c = 0; c < bed.channels.size(); ++c) {
    const ConditionsAt at = conditions_of(bed, bed.channels[c]);
    auto part = carried.segment(bed.offset(c), bed.channels[c].mean.size());
    if (discrepancy_settings()[settings[c]].amplitude == 0) {
      part.setZero();
    } else {
      part = CarriedSurface(bed, c, settings[c], test.discrepancy(), part, place).at(at).mean;
    }
  }
  return carried;
}

/// What the test was measured to be on held-out conditions, by the effects, what the references
/// share and what the other conditions leave of the difference. Of the last two together counts
/// what proves itself, per channel.
/// \param shared as a model file carries it
HeldOut hold_out_with_shared(const CalibratedRecording& difference, const MeasuredTest& measured,
                             const Eigen::VectorXd& shared, const CandidateFit& fit,
                             const HeldOut& by_effects, int threads) {
  const CandidateFit* effects = fit.candidate.effects.empty() ? nullptr : &fit;
  const CorrectedModel model{.fit = effects,
                             .remainder = remainder_settings(difference.problem(), fit)};
  HeldOut result = difference.held_out(model, by_effects.families, threads);
  const Eigen::VectorXd unnamed = shared + result.corrected - by_effects.corrected,
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
  const std::vector<std::size_t> settings = remainder_settings(test.problem(), fit);
  const Eigen::VectorXd shared = carried_of_shared(test, settings, measured.shared);
  Correction correction = correction_by(
      test, fit, settings, hold_out_with_shared(difference, measured, shared, fit, proof, threads),
      threads);
  correction.soil.standard_deviation = measured.soil.standard_deviation;
  correction.soil_pulls = pulls_by_references(measured);
  return correction;
}

}  // namespace regoplan
