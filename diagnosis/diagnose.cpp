#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "diagnosis/checks/bed_memory.h"
#include "diagnosis/checks/detection.h"
#include "diagnosis/checks/instrument_checks.h"
#include "diagnosis/checks/location.h"
#include "diagnosis/checks/smallest_detectable.h"
#include "diagnosis/diagnosis.h"
#include "diagnosis/fit/effect_list.h"
#include "diagnosis/fit/unnamed_correction.h"
#include "diagnosis/names/calibrated_recording.h"
#include "diagnosis/names/claim.h"
#include "diagnosis/names/claim_shares.h"
#include "diagnosis/names/claimed_place.h"
#include "diagnosis/names/correction.h"
#include "diagnosis/names/name_contest.h"
#include "diagnosis/names/next_experiment.h"
#include "diagnosis/names/partial_claim.h"
#include "diagnosis/names/suspects.h"
#include "diagnosis/recording/thresholds.h"
#include "diagnosis/stages.h"
#include "terramech/basics/interruption.h"

namespace regoplan {
namespace {

/// One diagnosis under way: what has been found, and the parts that later steps build on.
class Diagnosing {
 public:
  Diagnosing(const Recording& recording, const DiagnosisSetup& setup,
             const DiagnosisOptions& options)
      : options_(options),
        calibrated_(recording, setup, options.stop),
        effects_(effects_for(calibrated_.bed(), recording)),
        effects_in_part_(effects_for(calibrated_.bed(), recording, EffectsOf::kPart)) {
    // What is known to the last term leaves nothing beside it.
    std::erase_if(effects_in_part_, has_one_form);
    found_.soil = calibrated_.soil_pulls();
    found_.notes = recording.warnings;
    add_notes(calibrated_.recording().notes);
    for (const ChannelNoise& noise : calibrated_.recording().noise) {
      if (noise.source == NoiseSource::kNeighbours) found_.guessed_noise.push_back(noise.channel);
    }
    add_notes(instrument_checks(calibrated_.recording()));
  }

  Diagnosis run() {
    return run_stages(found_, complete_, [&] { find(); });
  }

 private:
  void find() {
    tell("testing for lack of fit", 0.05);
    detect();
    tell("locating the mismatch", 0.1);
    if (rejected_) locate_mismatch(calibrated_.remainder_of(calibrated_.base()));
    complete_ = found_;
    tell("scoring what may be wrong", 0.15);
    const bool located = rejected_;
    look_for_names();
    if (rejected_ && !located) {
      locate_mismatch(calibrated_.remainder_of(calibrated_.base()));
    }
    found_.ranking = ranking();
    complete_ = found_;
    tell("proving it on held-out conditions", 0.85);
    decide();
    found_.ranking = partial_ranking_.empty() ? ranking() : std::move(partial_ranking_);
    complete_ = found_;
    const bool nothing_missing =
        found_.verdict == Verdict::kConsistent || found_.verdict == Verdict::kParameters;
    if (nothing_missing) {
      found_.smallest_detectable = smallest_detectable(calibrated_.problem(), calibrated_.base(),
                                                       effects_, found_.before.critical);
    }
    tell("choosing the next experiment", 0.95);
    if (!nothing_missing) found_.next_experiments = experiments();
    tell("done", 1);
  }

  void tell(std::string_view what, double share) const {
    if (options_.progress) options_.progress(what, share);
  }
  void add_notes(const std::vector<std::string>& notes) {
    found_.notes.insert(found_.notes.end(), notes.begin(), notes.end());
  }

  void detect() {
    constexpr double kWide = CalibratedRecording::kWideSoil;
    const CondensedRecording& recording = calibrated_.recording();
    const CandidateFit& base = calibrated_.base();
    const auto loose =
        fit_under(calibrated_.wide_problem(), {}, base.evidence.settings, base.x / kWide, 12, 0);
    FitRemainder remainder = calibrated_.remainder_of(loose ? *loose : base);
    remainder.truth_spread = 1 / kWide;
    found_.before = lack_of_fit(recording, remainder, options_.seed);
    found_.after = found_.before;
    unfit_ = found_.before.f > found_.before.critical;
    beyond_doubt_ = unfit_ && lack_of_fit(recording, remainder, options_.seed,
                                          Thresholds::kBeyondDoubt_p, NoiseTails::kHeavy)
                                      .p_value < Thresholds::kBeyondDoubt_p;
    if (loose && !unfit_ && kWide * loose->x.lpNorm<Eigen::Infinity>() > Thresholds::kWorstPull) {
      // too far, unless numbers nearer to their tests fit as well
      const LackOfFit near = lack_of_fit(recording, calibrated_.remainder_of(base), options_.seed);
      unfit_ = near.f > near.critical;
      beyond_doubt_ = unfit_;
    }
    // so far no soil lies from its tests, however well it fits
    if (base.x.size() > 0 && base.x.lpNorm<Eigen::Infinity>() > Thresholds::kWorstPull) {
      unfit_ = true;
      beyond_doubt_ = true;
    }
    // replicates that follow a course differ by more than noise, whatever their means do
    const auto& course = recording.course;
    if (course && !course->after_run()) {
      unfit_ = true;
      beyond_doubt_ = true;
    }
    if (deviations_of_memory(calibrated_.problem(), base) > Thresholds::kMemory_deviations) {
      found_.notes.push_back("what soil numbers leave follows the slip of the run before");
      unfit_ = true;
      beyond_doubt_ = true;
    }
    stands_out_ =
        p_value_along(recording, remainder, directions(), options_.seed) < Thresholds::kLackOfFit_p;
    rejected_ = unfit_ || stands_out_;
    const FitRemainder fixed{
        .residual = calibrated_.bed().measured() - calibrated_.prediction_at_prior_means(),
        .x = Eigen::VectorXd(0),
        .jacobian = Eigen::MatrixXd(calibrated_.bed().size(), 0)};
    const LackOfFit at_means =
        lack_of_fit(recording, fixed, options_.seed, Thresholds::kConsistent_p);
    consistent_ = at_means.f <= at_means.critical;
    if (consistent_) return;
    if (!calibrated_.soil_explains_something()) {
      consistent_ = true;
      found_.notes.push_back(
          fmt::format("noise alone misfits the prior soil numbers as far with a probability of "
                      "{:.2g}; other soil numbers explain nothing of it",
                      at_means.p_value));
      return;
    }
    // soil numbers that fit some channels at the cost of another are not those of the soil
    const HeldOut& proof = calibrated_held_out();
    const std::string worse = worse_than_prior_means(calibrated_, proof);
    if (worse.empty() || !has_clear_excess(calibrated_.bed(), proof)) return;
    if (!misses(proof, &ChannelFit::baseline_rmse)) return;
    if (!misses(proof, &ChannelFit::calibrated_rmse)) return;
    found_.notes.push_back(worse);
    unfit_ = true;
    rejected_ = true;
  }

  /// What the calibrated model predicts on held-out conditions.
  const HeldOut& calibrated_held_out() {
    if (!calibrated_held_out_) {
      calibrated_held_out_ = calibrated_.held_out({}, options_.threads);
    }
    return *calibrated_held_out_;
  }

  /// Whether a model misses some held-out channel by more than one run scatters: nearer by, it may
  /// be handed on though another predicts better.
  static bool misses(const HeldOut& proof, double ChannelFit::*rmse) {
    return std::ranges::any_of(proof.fit, [rmse](const ChannelFit& fit) {
      return std::pow(fit.*rmse, 2) > 2 * std::pow(fit.noise_floor, 2);
    });
  }

  /// Where replicates follow a course, the part of it in which a channel is off comes first.
  void locate_mismatch(const FitRemainder& off) {
    const CondensedRecording& recording = calibrated_.recording();
    found_.where = locate(recording, off, options_.seed + 1);
    if (!recording.course || recording.course->in_place()) return;
    if (auto when = last_part_of(recording)) found_.where.insert(found_.where.begin(), *when);
  }

  /// What is claimed says itself when or on which stretch it acts: nearer than a scan does. Soil
  /// that was fitted without it takes part of it up, and is off where nothing else is at work: the
  /// claim acts where what was measured is off the soil fitted beside it.
  void take_places_of(const CandidateFit& fit) {
    std::vector<MismatchRegion> off_calibrated = std::move(found_.where);
    locate_mismatch(calibrated_.off_soil_beside(fit));
    if (found_.where.empty()) {
      found_.where = std::move(off_calibrated);
    } else {
      found_.where_off = WhereOff::kSoilBesideClaim;
    }
    const std::vector<MismatchRegion> places = claimed_places(calibrated_.problem(), fit);
    found_.where.insert(found_.where.begin(), places.begin(), places.end());
  }

  /// What each effect at a usual size would add to the calibrated model.
  std::vector<Direction> directions() const {
    const CandidateFit& base = calibrated_.base();
    std::vector<Direction> all;
    for (const Effect& effect : effects_) {
      Eigen::VectorXd x(base.x.size() + static_cast<Eigen::Index>(effect.coordinates.size()));
      x.head(base.x.size()) = base.x;
      bool either_sign = false;
      for (std::size_t i = 0; i < effect.coordinates.size(); ++i) {
        const bool is_signed = !effect.coordinates[i].is_positive();
        x[base.x.size() + static_cast<Eigen::Index>(i)] = is_signed ? 1 : 0;
        either_sign = either_sign || is_signed;
      }
      const auto with = predict(calibrated_.bed(), calibrated_.soil(), {{effect}}, x);
      if (with) all.push_back({*with - base.prediction, either_sign});
    }
    return all;
  }

  void look_for_names() {
    scored_ = score_candidates(calibrated_.problem(), calibrated_.wide_problem(), effects_,
                               {.threads = options_.threads, .progress = [&](double share) {
                                  tell("scoring what may be wrong", 0.15 + 0.7 * share);
                                }});
    // it is scored beside a small remainder, and the tests have found one that is not small
    for (ScoredId& s : scored_) {
      if (s.account.kind == Account::Kind::kNone) s.given_up = !consistent_;
    }
    weigh(scored_, plain_model());
    found_.support = support_of(scored_, plain_model());
    if (found_.support.best_gain_nats > Thresholds::kNoChance_nats) {
      unfit_ = true;
      beyond_doubt_ = true;
    }
    rejected_ = rejected_ || unfit_ || found_.support.best_gain_nats > Thresholds::kUnprompted_nats;
    weigh(scored_, plain_model());
  }

  PlainModel plain_model() const {
    if (unfit_) return PlainModel::kRefuted;
    return rejected_ ? PlainModel::kDoubted : PlainModel::kHolds;
  }

  /// What names may be claimed.
  std::optional<ProvenClaim> claim_of_names() {
    NameContest contest(calibrated_, scored_, plain_model(), options_.seed, options_.threads);
    auto claim = contest.decide();
    scored_ = contest.scored();
    add_notes(contest.notes());
    return claim;
  }

  void decide() {
    if (!rejected_) {
      nothing_is_missing();
      return;
    }
    if (const auto claim = claim_of_names()) {
      found_.claims = claims_of(calibrated_.problem(), scored_, claim->names, claim->fit);
      if (is_class(found_.claims)) members_ = members_of(scored_, claim->names);
      measure_shares(calibrated_, scored_, claim->fit, options_.threads, found_.claims);
      found_.remainder_share = remainder_share(found_.claims);
      take_places_of(claim->fit);
      take(
          correction_by(calibrated_, claim->fit, claim->remainder, claim->proof, options_.threads));
      found_.verdict = verdict_of_names(found_);
      return;
    }
    if (unfit_ && named_in_part()) return;
    if (unfit_) {
      Correction correction = correction_without_name(calibrated_, scored_, options_.threads);
      const bool proven = correction.refused.empty() &&
                          correction.proof.share_explained > Thresholds::kWorthCorrecting;
      if (proven || beyond_doubt_) {
        found_.verdict = Verdict::kUnexplained;
        found_.remainder_share = 1;
        take(std::move(correction));
        return;
      }
      const bool shows = found_.before.f > found_.before.critical;
      found_.notes.push_back(fmt::format(
          "{}, but no correction proves its worth on held-out conditions: it is taken "
          "for chance",
          shows ? fmt::format("there may be a lack of fit (p = {:.2g})", found_.before.p_value)
                : "something may be missing"));
    }
    // what spoke against the calibrated model does not hold
    if (!unfit_) {
      found_.notes.push_back(
          "the recording stands out along what some effect would do, but no name is sure of it and "
          "proves itself held out: it is taken for chance");
    }
    nothing_is_missing();
  }

  /// A fault of an instrument, known to the last term and so no name in part, that explains the
  /// whole recording clearly better than a misfit without a name does and than the names of a
  /// claim; null where there is none.
  const ScoredId* fault_that_does_better(const Claim& claim) const {
    const ScoredId* fault = nullptr;
    double claimed = -INFINITY;
    for (const ScoredId& s : scored_) {
      if (s.fit.candidate.effects.size() != 1) continue;
      const std::string& id = s.fit.candidate.effects.front().id;
      if (claim.is_of(id)) {
        claimed = std::max(claimed, s.score);
      } else if (has_one_form(s.fit.candidate.effects.front()) &&
                 (fault == nullptr || s.score > fault->score)) {
        fault = &s;
      }
    }
    const double others = std::max(claimed, scored_as(Account::Kind::kUnexplained, scored_).score);
    const bool better = fault != nullptr && fault->score > others + Thresholds::kAsGood_nats;
    return better ? fault : nullptr;
  }

  /// Names that stand beside an unnamed remainder.
  bool named_in_part() {
    tell("scoring names beside a remainder", 0.88);
    PartialDecision part =
        decide_partly(calibrated_, effects_in_part_, options_.seed + 2, options_.threads);
    found_.chance_nats = part.chance_nats;
    if (!part.claim) {
      if (!part.refused.empty()) found_.notes.push_back("no name in part: " + part.refused);
      return false;
    }
    if (const ScoredId* fault = fault_that_does_better(part.claim->claims.front())) {
      found_.notes.push_back(
          fmt::format("no name in part: {} does better, without a remainder", fault->id()));
      return false;
    }
    found_.verdict = Verdict::kPartly;
    found_.names_added = steps_of(calibrated_, *part.claim, options_.threads);
    found_.claims = std::move(part.claim->claims);
    if (part.claim->members.size() > 1) {
      for (const CandidateFit& fit : part.claim->members) {
        const std::string& id = fit.candidate.effects.front().id;
        members_.push_back(
            {.account = {.kind = Account::Kind::kEffects, .effects = {id}}, .fit = fit});
      }
    }
    partial_ranking_ = std::move(part.ranking);
    found_.remainder_share = remainder_share(found_.claims);
    const CandidateFit& fit = part.claim->fit;
    take_places_of(fit);
    const std::vector<std::size_t> left = remainder_settings(calibrated_.problem(), fit);
    take(correction_by(calibrated_, fit, left,
                       calibrated_.held_out({.fit = &fit, .remainder = left}, options_.threads),
                       options_.threads));
    return true;
  }

  /// Replicates that follow the run before are no clean bill, whatever their means do: the bed was
  /// not alike for them.
  void only_bed_memory() {
    found_.verdict = Verdict::kUnexplained;
    found_.only_bed_memory = true;
    found_.remainder_share = 1;
    weigh(scored_, PlainModel::kRefuted);
    if (found_.where.empty()) {
      if (auto after = last_part_of(calibrated_.recording())) found_.where.push_back(*after);
    }
    take(calibrated_alone(calibrated_, calibrated_held_out(), options_.threads));
  }

  void nothing_is_missing() {
    const auto& course = calibrated_.recording().course;
    if (course && course->after_run()) {
      only_bed_memory();
      return;
    }
    weigh(scored_, PlainModel::kHolds);
    if (!consistent_) found_.suspects = suspects_of(calibrated_, scored_);
    found_.verdict = consistent_ ? Verdict::kConsistent : Verdict::kParameters;
    take(calibrated_alone(calibrated_, calibrated_held_out(), options_.threads));
  }

  void take(Correction correction) {
    found_.correction_refused = !correction.refused.empty();
    if (found_.correction_refused) {
      found_.notes.push_back(
          fmt::format("the model is handed on without a correction: {}", correction.refused));
    }
    if (!correction.despite.empty()) found_.notes.push_back(correction.despite);
    if (!correction.carried.empty()) found_.notes.push_back(correction.carried);
    found_.fit = correction.proof.fit;
    found_.held_out_by = correction.proof.families.by;
    found_.share_explained = correction.proof.share_explained;
    found_.excess_is_clear = has_clear_excess(calibrated_.bed(), correction.proof);
    found_.corrected_model = std::move(correction.model);
    found_.corrected_soil = correction.soil;
    found_.soil = std::move(correction.soil_pulls);
    found_.residuals = std::move(correction.residuals);
    if (!found_.claims.empty() || correction.adds_remainder) {
      found_.after = lack_of_fit(calibrated_.recording(), correction.remainder, options_.seed);
    }
  }

  std::vector<ScoredCandidate> ranking() const {
    std::vector<ScoredCandidate> all;
    const double parameters = scored_as(Account::Kind::kParameters, scored_).score;
    for (const ScoredId& s : scored_) {
      all.push_back({s.id(), s.probability, s.score - parameters});
    }
    return all;
  }

  /// Between the names of a class, else between the likeliest.
  std::vector<Experiment> experiments() const {
    constexpr std::size_t kMostRivals = Thresholds::kLargestClass;
    std::vector<ScoredId> rivals = members_;
    for (const ScoredId& s : scored_) {
      if (!members_.empty() || rivals.size() == kMostRivals) break;
      if (s.account.kind == Account::Kind::kEffects) rivals.push_back(s);
    }
    return next_experiments(calibrated_.problem(), rivals);
  }

  const DiagnosisOptions& options_;
  const CalibratedRecording calibrated_;
  std::optional<HeldOut> calibrated_held_out_;  // once it was asked for
  std::vector<Effect> effects_, effects_in_part_;
  std::vector<ScoredId> scored_;
  std::vector<ScoredCandidate> partial_ranking_;
  std::vector<ScoredId> members_;  // of the class, where one is claimed
  bool stands_out_ = false;        // the residual lies along some effect farther than noise goes
  bool unfit_ = false;             // lack of fit, or soil numbers that calibration pulled too far
  bool beyond_doubt_ = false;      // unfit, even where no correction proves itself
  bool rejected_ = false;          // that, or a name far better than calibration alone
  bool consistent_ = false;
  Diagnosis found_;
  Diagnosis complete_;  // the stages of it that are
};

}  // namespace

Diagnosis diagnose(const Recording& recording, const DiagnosisSetup& setup,
                   const DiagnosisOptions& options) {
  if (options.progress) options.progress("calibrating the soil numbers", 0.02);
  try {
    return Diagnosing(recording, setup, options).run();
  } catch (const Interrupted&) {  // before there was a calibrated model
    return undecided(recording);
  }
}

}  // namespace regoplan
