#include "diagnosis/proven_difference.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "diagnosis/checks/detection.h"
#include "diagnosis/names/partial_claim.h"
#include "diagnosis/recording/thresholds.h"

namespace regoplan {
namespace {

/// A constant of each channel and a share of its signal: what most effects do to it in the mean.
std::vector<Direction> shifts_of_channels(const CalibratedRecording& calibrated) {
  const TestBed& bed = calibrated.bed();
  std::vector<Direction> shifts;
  for (std::size_t c = 0; c < bed.channels.size(); ++c) {
    const Eigen::Index from = bed.offset(c), n = bed.channels[c].mean.size();
    Direction constant{.values = Eigen::VectorXd::Zero(bed.size()), .either_sign = true};
    Direction share = constant;
    constant.values.segment(from, n).setOnes();
    share.values.segment(from, n) = calibrated.base().prediction.segment(from, n);
    if (const auto& shared = bed.channels[c].shared; shared.size() > 0) {
      share.values.segment(from, n) += shared;
    }
    shifts.push_back(std::move(constant));
    shifts.push_back(std::move(share));
  }
  return shifts;
}

/// The run of each channel that is farthest off, in standard deviations, no farther than the next.
void cut_lone_runs(const TestBed& bed, FitRemainder& remainder) {
  for (std::size_t c = 0; c < bed.channels.size(); ++c) {
    const Eigen::Index n = bed.channels[c].mean.size();
    if (n < 2) continue;
    auto left = remainder.residual.segment(bed.offset(c), n);
    Eigen::ArrayXd off = left.array().abs() / bed.channels[c].noise.diagonal().array().sqrt();
    Eigen::Index farthest = 0;
    const double most = off.maxCoeff(&farthest);
    if (most == 0) continue;
    off[farthest] = 0;
    left[farthest] *= off.maxCoeff() / most;
  }
}

}  // namespace

LackOfFit lack_of_difference(const CalibratedRecording& calibrated, const CandidateFit& fit,
                             std::uint64_t seed) {
  const CondensedRecording& recording = calibrated.recording();
  FitRemainder remainder = calibrated.remainder_of(fit);
  const NoiseTails tails = tails_of(recording);
  if (tails == NoiseTails::kHeavy) cut_lone_runs(calibrated.bed(), remainder);
  constexpr int kTests = 2;
  constexpr int kDraws = kTests * kNoiseDraws;
  LackOfFit lack =
      lack_of_fit(recording, remainder, seed, Thresholds::kDifference_p / kTests, tails, kDraws);
  const double along =
      p_value_along(recording, remainder, shifts_of_channels(calibrated), seed, tails, kDraws);
  lack.p_value = std::min(1.0, kTests * std::min(lack.p_value, along));
  return lack;
}

bool is_proven(const LackOfFit& lack) {
  return lack.p_value < Thresholds::kDifference_p;
}

bool leaves_a_part(const LackOfFit& left, const std::vector<Claim>& claims) {
  const bool is_told = std::ranges::all_of(claims, [](const Claim& c) { return !!c.share; });
  return is_proven(left) && !(is_told && remainder_share(claims) < Thresholds::kWorthAnother);
}

double probability_of_no_difference(double p) {
  const auto bayes_factor = [](double p_value) {
    return p_value < std::exp(-1) ? -std::exp(1) * p_value * std::log(p_value) : 1;
  };
  const double odds = bayes_factor(p) / bayes_factor(Thresholds::kDifference_p);
  return odds / (1 + odds);
}

}  // namespace regoplan
