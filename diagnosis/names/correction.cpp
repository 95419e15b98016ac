#include "diagnosis/names/correction.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/fit/carried_surface.h"
#include "diagnosis/fit/unnamed_correction.h"
#include "diagnosis/recording/thresholds.h"

namespace regoplan {
namespace {

/// What a fit predicts with an unnamed correction, as the model file has it.
Eigen::VectorXd with_correction(const TestBed& bed, Eigen::VectorXd prediction,
                                const GenericCorrection& correction) {
  for (std::size_t c = 0; c < bed.channels.size(); ++c) {
    const ChannelData& data = bed.channels[c];
    for (std::size_t i = 0; i < data.conditions.size(); ++i) {
      const Condition& at = bed.conditions[data.conditions[i]];
      const CorrectionValue added =
          correction_at(correction, {.slip_ratio = at.slip_ratio,
                                     .slip_angle_rad = std::abs(at.slip_angle_rad),
                                     .load_n = at.load_n})
              .value;
      double& value = prediction[bed.offset(c) + static_cast<Eigen::Index>(i)];
      if (data.channel == Channel::kFx) value += added.fx_n;
      if (data.channel == Channel::kFy) value += at.slip_angle_rad > 0 ? added.fy_n : -added.fy_n;
      if (data.channel == Channel::kTorque) value += added.torque_nm;
      if (data.channel == Channel::kSinkage) value += added.sinkage_m;
    }
  }
  return prediction;
}

/// Faults of instruments are no part of a model of the wheel.
std::vector<Mechanism> mechanisms_of(const CalibratedRecording& calibrated,
                                     const CandidateFit& fit) {
  std::vector<Mechanism> mechanisms;
  auto next = static_cast<Eigen::Index>(calibrated.soil().size());
  for (const Effect& effect : fit.candidate.effects) {
    const auto size = static_cast<Eigen::Index>(effect.coordinates.size());
    if (!is_instrument(effect.id)) {
      mechanisms.push_back(mechanism_at(effect, fit.x.segment(next, size)));
    }
    next += size;
  }
  return mechanisms;
}

/// \param by_calibrated what the calibrated model predicts \param corrected what is handed out does
std::vector<RunResidual> residuals_of(const CalibratedRecording& calibrated, const HeldOut& proof,
                                      const Eigen::VectorXd& by_calibrated,
                                      const Eigen::VectorXd& corrected) {
  const TestBed& bed = calibrated.bed();
  const CondensedRecording& recording = calibrated.recording();
  const Eigen::VectorXd means = calibrated.prediction_at_prior_means();
  std::vector<RunResidual> residuals;
  for (std::size_t c = 0; c < bed.channels.size(); ++c) {
    const ChannelData& data = bed.channels[c];
    for (std::size_t i = 0; i < data.conditions.size(); ++i) {
      const Eigen::Index row = bed.offset(c) + static_cast<Eigen::Index>(i);
      for (const std::size_t run : bed.conditions[data.conditions[i]].runs) {
        const double y = recording.adjusted[c][run];
        if (!std::isfinite(y)) continue;
        residuals.push_back({.run = run,
                             .channel = data.channel,
                             .measured = y,
                             .noise = run_deviation(recording.noise[c], y),
                             .baseline = means[row],
                             .calibrated = by_calibrated[row],
                             .corrected = corrected[row],
                             .held_out = proof.corrected[row],
                             .held_out_standard_deviation = proof.corrected_deviation[row]});
      }
    }
  }
  return residuals;
}

/// As correction_by(), whatever the proof says.
/// \param by_calibrated what the calibrated model predicts, for comparison
Correction handed_out(const CalibratedRecording& calibrated, const CandidateFit& fit,
                      const std::vector<std::size_t>& settings, const HeldOut& proof,
                      const Eigen::VectorXd& by_calibrated) {
  const DiagnosisSetup& setup = calibrated.bed().setup;
  const std::vector<SoilCoordinate>& soil = calibrated.soil();
  Correction correction{.model = {.variant = setup.variant,
                                  .wheel = setup.wheel,
                                  .soil = soil_of(calibrated.bed(), soil, fit.candidate, fit.x),
                                  .gravity_mps2 = setup.gravity_mps2,
                                  .mechanisms = mechanisms_of(calibrated, fit)},
                        .soil_pulls = calibrated.soil_pulls(),
                        .proof = proof,
                        .remainder = calibrated.remainder_of(fit),
                        .adds_remainder = !settings.empty()};
  correction.soil = {.mean = correction.model.soil,
                     .standard_deviation = setup.soil.standard_deviation};
  for (std::size_t i = 0; i < soil.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    correction.soil_pulls[i].corrected = calibrated.soil_estimate(fit, i);
    correction.soil_pulls[i].corrected_pull = fit.x[k];
    correction.soil.standard_deviation.*soil_parameters()[soil[i].parameter].member =
        soil[i].coordinate.spread * std::sqrt(fit.evidence.covariance(k, k));
  }
  Eigen::VectorXd corrected = fit.prediction;
  if (!settings.empty()) {
    GenericCorrection generic =
        unnamed_correction(calibrated.problem(), fit, settings, proof.remainder_share);
    // one that adds nothing would only make the rest of the world `outside_correction`
    if (!generic.nodes.empty()) {
      corrected = with_correction(calibrated.bed(), std::move(corrected), generic);
      correction.model.generic = std::move(generic);
      correction.carried = words_of_carried(calibrated.bed());
    }
    correction.remainder.residual = calibrated.bed().measured() - corrected;
  }
  correction.residuals = residuals_of(calibrated, proof, by_calibrated, corrected);
  return correction;
}

Correction calibrated_model(const CalibratedRecording& calibrated, const HeldOut& proof) {
  return handed_out(calibrated, calibrated.base(), {}, proof, calibrated.base().prediction);
}

/// The recording with the soil known at its prior means.
CondensedRecording with_known_soil(CondensedRecording recording) {
  recording.bed.setup.soil = {.mean = recording.bed.setup.soil.mean};
  return recording;
}

/// Model at the prior means, and a surface over it where that proves itself. What is told of the
/// calibrated model stays that of the calibrated model.
Correction at_prior_means(const CalibratedRecording& calibrated, bool with_surface,
                          const HeldOut& of_calibrated, int threads) {
  const CalibratedRecording known(with_known_soil(calibrated.recording()));
  HeldOut proof = known.held_out({}, of_calibrated.families, threads);
  std::vector<std::size_t> settings;
  if (with_surface) {
    std::vector<std::size_t> surface = remainder_settings(known.problem(), known.base());
    HeldOut over = known.held_out({.remainder = surface}, of_calibrated.families, threads);
    if (variances_off(known.bed(), over.corrected) < variances_off(known.bed(), proof.corrected)) {
      settings = std::move(surface);
      proof = std::move(over);
    }
  }
  for (std::size_t c = 0; c < proof.fit.size(); ++c) {
    proof.fit[c].calibrated_rmse = of_calibrated.fit[c].calibrated_rmse;
  }
  const auto rows = static_cast<double>(known.bed().size());
  proof.share_explained =
      of_calibrated.excess > 0
          ? 1 - (variances_off(known.bed(), proof.corrected) - rows) / of_calibrated.excess
          : 0;
  proof.excess = of_calibrated.excess;
  Correction correction =
      handed_out(known, known.base(), settings, proof, calibrated.base().prediction);
  correction.soil = calibrated.bed().setup.soil;
  correction.soil_pulls = calibrated.soil_pulls();
  for (SoilPull& pull : correction.soil_pulls) {
    pull.corrected = pull.prior;
    pull.corrected_pull = 0;
  }
  return correction;
}

/// The soil fitted to noise as wide as what it leaves.
std::optional<CandidateFit> soil_near_tests(const CalibratedRecording& calibrated) {
  constexpr int kSteps = 8;
  const FitProblem problem = calibrated.problem();
  return fit_to_widened(problem, {}, deviations_off(problem.bed, calibrated.base().prediction),
                        start_of(problem, {}), kSteps);
}

/// Whether soil numbers that lie farther from their tests than soils lie, calibrated alone, come
/// back within that beside what is claimed. Such numbers may predict well where they were fitted;
/// they are no soil, and go astray elsewhere.
bool brings_soil_back(const CalibratedRecording& calibrated, const CandidateFit& fit) {
  const Eigen::VectorXd& alone = calibrated.base().x;
  return !fit.candidate.effects.empty() && alone.size() > 0 &&
         alone.lpNorm<Eigen::Infinity>() > Thresholds::kWorstPull &&
         fit.x.head(alone.size()).lpNorm<Eigen::Infinity>() <= Thresholds::kWorstPull;
}

/// Why the prior means are handed on in place of the calibrated model; empty where they are not: of
/// two that each spoil a channel of the other's the calibrated one is what others are held to.
std::string prior_means_for(const CalibratedRecording& calibrated, const HeldOut& proof) {
  const bool they_spoil =
      clear_loss(calibrated.bed(), calibrated.prediction_at_prior_means(), proof.calibrated)
          .has_value();
  return they_spoil ? "" : worse_than_prior_means(calibrated, proof);
}

}  // namespace

std::string worse_than_prior_means(const CalibratedRecording& calibrated, const HeldOut& proof) {
  const auto loss =
      clear_loss(calibrated.bed(), proof.calibrated, calibrated.prediction_at_prior_means());
  if (!loss) return "";
  return fmt::format(
      "held out by {}, calibrated soil numbers predict {} worse than the prior means by {:.1f} "
      "standard errors",
      proof.families.by, name(loss->channel), loss->errors);
}

Correction calibrated_alone(const CalibratedRecording& calibrated, const HeldOut& proof,
                            int threads) {
  std::string worse = prior_means_for(calibrated, proof);
  if (worse.empty()) return calibrated_model(calibrated, proof);
  Correction correction = at_prior_means(calibrated, false, proof, threads);
  correction.refused = "the soil stays at its prior means: " + worse;
  return correction;
}

Correction correction_by(const CalibratedRecording& calibrated, const CandidateFit& fit,
                         const std::vector<std::size_t>& remainder, const HeldOut& proof,
                         int threads) {
  std::string reason = no_better_than(proof.calibrated, calibrated.bed(), proof);
  std::string despite;
  if (!reason.empty() && brings_soil_back(calibrated, fit)) {
    despite = fmt::format(
        "calibrated soil numbers alone lie {:.1f} standard deviations from their tests: what is "
        "claimed is handed on, though against them, {}",
        calibrated.base().x.lpNorm<Eigen::Infinity>(), reason);
    reason = no_better_than(calibrated.prediction_at_prior_means(), calibrated.bed(), proof);
  }
  if (reason.empty()) {
    Correction correction =
        handed_out(calibrated, fit, remainder, proof, calibrated.base().prediction);
    correction.despite = std::move(despite);
    return correction;
  }
  const HeldOut plain = calibrated.held_out({}, proof.families, threads);
  const std::string worse = prior_means_for(calibrated, plain);
  Correction correction = worse.empty() ? calibrated_model(calibrated, plain)
                                        : at_prior_means(calibrated, false, plain, threads);
  correction.refused = worse.empty() ? std::move(reason) : reason + "; " + worse;
  return correction;
}

Correction correction_without_name(const CalibratedRecording& calibrated,
                                   const std::vector<ScoredId>& scored, int threads) {
  struct Proven {
    const CandidateFit* fit;
    std::vector<std::size_t> remainder;
    HeldOut proof;
  };
  const auto prove = [&](const CandidateFit* fit) {
    std::vector<std::size_t> remainder =
        remainder_settings(calibrated.problem(), fit == nullptr ? calibrated.base() : *fit);
    HeldOut proof = calibrated.held_out({.fit = fit, .remainder = remainder}, threads);
    return Proven{fit, std::move(remainder), std::move(proof)};
  };
  Proven best = prove(nullptr);
  Proven over_fit = prove(&scored_as(Account::Kind::kUnexplained, scored).fit);
  if (over_fit.proof.share_explained > best.proof.share_explained) best = std::move(over_fit);
  // Soil numbers that take a mismatch for their own go astray where it was not measured.
  const auto near_tests = soil_near_tests(calibrated);
  if (near_tests) {
    Proven over_near = prove(&*near_tests);
    if (over_near.proof.share_explained > best.proof.share_explained) best = std::move(over_near);
  }
  Correction at_means = at_prior_means(calibrated, true, best.proof, threads);
  const bool spoils =
      clear_loss(calibrated.bed(), at_means.proof.corrected, best.proof.calibrated).has_value();
  if (!spoils && variances_off(calibrated.bed(), at_means.proof.corrected) <
                     variances_off(calibrated.bed(), best.proof.corrected)) {
    return at_means;
  }
  return correction_by(calibrated, best.fit == nullptr ? calibrated.base() : *best.fit,
                       best.remainder, best.proof, threads);
}

}  // namespace regoplan
