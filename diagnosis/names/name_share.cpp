#include "diagnosis/names/name_share.h"

#include <algorithm>
#include <cmath>

#include "diagnosis/fit/unnamed_correction.h"

namespace regoplan {
namespace {

/// Of a prediction against one that it is to better, per kind of families.
NameShare compare(const CalibratedRecording& calibrated, const CandidateFit& with,
                  const CandidateFit* without, int threads) {
  const TestBed& bed = calibrated.bed();
  NameShare result{.share = {0, INFINITY, -INFINITY}, .gain_in_errors = INFINITY};
  std::vector<double> gains(bed.channels.size(), 0.0);
  const std::vector<Families> kinds = all_families(bed);
  const std::string first = families_of(bed).by;
  for (const Families& families : kinds) {
    const HeldOut held = calibrated.held_out({.fit = &with}, families, threads);
    Eigen::VectorXd before = held.calibrated;
    if (without != nullptr) {
      before = calibrated.held_out({.fit = without}, families, threads).corrected;
    }
    if (has_clear_excess(bed, held)) {
      const double share =
          (variances_off(bed, before) - variances_off(bed, held.corrected)) / held.excess;
      result.share.low = std::min(result.share.low, share);
      result.share.high = std::max(result.share.high, share);
      if (families.by == first || !result.is_told) {
        result.share.explained = share;
        result.held_out_by = families.by;
      }
      result.is_told = true;
    }
    result.gain_in_errors =
        std::min(result.gain_in_errors, gain_in_errors(bed, held.corrected, before));
    for (std::size_t c = 0; c < gains.size(); ++c) {
      gains[c] +=
          gain_in_errors(bed, c, held.corrected, before) / static_cast<double>(kinds.size());
    }
  }
  if (!result.is_told) result.share = {};
  const auto worst = std::ranges::min_element(gains);
  result.loss = {bed.channels[static_cast<std::size_t>(worst - gains.begin())].channel, -*worst};
  return result;
}

}  // namespace

CandidateFit fitted_alone(const CalibratedRecording& calibrated, const CandidateFit& fit) {
  constexpr int kSteps = 12;
  const std::vector<std::size_t> noise_only(calibrated.bed().channels.size(), 0);
  const auto refitted =
      fit_under(calibrated.problem(), fit.candidate, noise_only, fit.x, kSteps, 0);
  return refitted ? *refitted : fit;
}

NameShare name_share(const CalibratedRecording& calibrated, const CandidateFit& fit, int threads) {
  return compare(calibrated, fit, nullptr, threads);
}

NameShare added_share(const CalibratedRecording& calibrated, const CandidateFit& with,
                      const CandidateFit& without, int threads) {
  return compare(calibrated, with, &without, threads);
}

bool extrapolates_better(const CalibratedRecording& calibrated, const CandidateFit& fit,
                         const std::vector<std::size_t>& by_surface, int threads) {
  const TestBed& bed = calibrated.bed();
  const std::vector<std::size_t> left = remainder_settings(calibrated.problem(), fit);
  double named = 0, surface = 0;
  for (const Families& families : all_families(bed)) {
    const HeldOut with = calibrated.held_out({.fit = &fit, .remainder = left}, families, threads);
    const HeldOut alone = calibrated.held_out({.remainder = by_surface}, families, threads);
    for (std::size_t c = 0; c < bed.channels.size(); ++c) {
      const ChannelData& data = bed.channels[c];
      for (std::size_t i = 0; i < data.conditions.size(); ++i) {
        const std::size_t family = families.of_condition[data.conditions[i]];
        if (family != 0 && family + 1 != families.count) continue;
        const auto k = static_cast<Eigen::Index>(i);
        const Eigen::Index row = bed.offset(c) + k;
        named += std::pow(data.mean[k] - with.corrected[row], 2) / data.noise(k, k);
        surface += std::pow(data.mean[k] - alone.corrected[row], 2) / data.noise(k, k);
      }
    }
  }
  return named < surface;
}

}  // namespace regoplan
