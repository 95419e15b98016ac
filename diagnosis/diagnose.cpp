#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/calibration.h"
#include "diagnosis/claim.h"
#include "diagnosis/detection.h"
#include "diagnosis/held_out.h"
#include "diagnosis/instrument_checks.h"
#include "diagnosis/location.h"
#include "diagnosis/next_experiment.h"
#include "diagnosis/sentence.h"
#include "diagnosis/smallest_detectable.h"
#include "diagnosis/stray_runs.h"
#include "diagnosis/unnamed_correction.h"
#include "terramech/input_error.h"

namespace regoplan {
namespace {

constexpr double kWorstPull = 4.5;    // prior standard deviations that calibration may need
constexpr double kWideSoil = 3;       // priors are widened so far for the verdict `parameters`
constexpr double kClearEvidence = 9;  // nats by which a name must beat `parameters` unprompted
constexpr double kClearGain = 2;      // standard errors of the held-out gain
constexpr double kWorthNaming = 0.5;  // share of the excess misfit that a claim explains

/// The recording condensed, strays weighed down.
CondensedRecording prepared(const Recording& recording, const DiagnosisSetup& setup) {
  CondensedRecording condensed = condense(recording, setup);
  const Calibration first = calibrate(condensed.bed, soil_coordinates(setup.soil));
  return strays_weighed_down(recording, std::move(condensed), first.prediction);
}

/// One diagnosis under way: what has been found, and the parts that later steps build on.
class Diagnosing {
 public:
  Diagnosing(const Recording& recording, const DiagnosisSetup& setup,
             const DiagnosisOptions& options)
      : options_(options),
        condensed_(prepared(recording, setup)),
        bed_(condensed_.bed),
        soil_(soil_coordinates(setup.soil)),
        wide_soil_(soil_coordinates(setup.soil, kWideSoil)),
        discrepancy_(bed_),
        measured_(bed_.measured()) {
    found_.notes = recording.warnings;
    found_.notes.insert(found_.notes.end(), condensed_.notes.begin(), condensed_.notes.end());
    for (const std::string& check : instrument_checks(condensed_)) found_.notes.push_back(check);
    effects_ = effects_for(bed_, recording);
  }

  Diagnosis run() {
    tell("calibrating the soil numbers", 0.02);
    calibrate_soil();
    tell("testing for lack of fit", 0.05);
    detect();
    if (!rejected_ && !stopped()) found_.smallest_detectable = detectable();
    tell("locating the mismatch", 0.1);
    if (rejected_ && !stopped()) {
      found_.where = locate(condensed_, remainder_of(base_), options_.seed + 1);
    }
    tell("scoring what may be wrong", 0.15);
    score();
    tell("proving it on held-out conditions", 0.85);
    decide();
    tell("choosing the next experiment", 0.95);
    if (rejected_ && !stopped()) found_.next_experiments = experiments();
    found_.interrupted = stopped();
    found_.sentence = sentence_of(found_);
    tell("done", 1);
    return std::move(found_);
  }

 private:
  bool stopped() const { return options_.stop.stop_requested(); }
  void tell(std::string_view what, double share) const {
    if (options_.progress) options_.progress(what, share);
  }

  void calibrate_soil() {
    const Calibration calibration = calibrate(bed_, soil_);
    base_.x = calibration.x;
    base_.prediction = calibration.prediction;
    base_.jacobian = calibration.jacobian;
    base_.evidence.covariance = calibration.covariance;
    base_.evidence.settings.assign(bed_.channels.size(), 0);
    soil_free_ = soil_directions(bed_, base_.jacobian);
    for (std::size_t i = 0; i < soil_.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      const SoilParameter& p = soil_parameters()[soil_[i].parameter];
      const Coordinate& c = soil_[i].coordinate;
      SoilPull pull{.parameter = c.name,
                    .prior = {c.centre / p.file_unit, c.spread / p.file_unit},
                    .pull = base_.x[k]};
      pull.calibrated = estimate(base_, k, p.file_unit);
      pull.corrected = pull.calibrated;
      pull.corrected_pull = pull.pull;
      found_.soil.push_back(pull);
    }
  }

  Estimate estimate(const CandidateFit& fit, Eigen::Index k, double unit) const {
    const Coordinate& c = soil_[static_cast<std::size_t>(k)].coordinate;
    return {c.value(fit.x[k]) / unit, c.spread * std::sqrt(fit.evidence.covariance(k, k)) / unit};
  }

  FitRemainder remainder_of(const CandidateFit& fit) const {
    return {.residual = measured_ - fit.prediction, .x = fit.x, .jacobian = fit.jacobian};
  }

  void detect() {
    const FitProblem wide{bed_, wide_soil_, discrepancy_, soil_free_};
    const auto loose = fit_under(wide, {}, base_.evidence.settings, base_.x / kWideSoil, 12, 0);
    FitRemainder remainder = remainder_of(loose ? *loose : base_);
    remainder.truth_spread = 1 / kWideSoil;
    found_.before = lack_of_fit(condensed_, remainder, options_.seed);
    found_.after = found_.before;
    unfit_ = found_.before.f > found_.before.critical;
    for (Eigen::Index i = 0; i < base_.x.size() && loose; ++i) {
      if (std::abs(kWideSoil * loose->x[i]) > kWorstPull) unfit_ = true;
    }
    stands_out_ = p_value_along(condensed_, remainder, directions(), options_.seed) < 0.005;
    rejected_ = unfit_ || stands_out_;
    const FitRemainder fixed{
        .residual = measured_ - *predict(bed_, soil_, {}, Eigen::VectorXd::Zero(base_.x.size())),
        .x = Eigen::VectorXd(0),
        .jacobian = Eigen::MatrixXd(bed_.size(), 0)};
    const LackOfFit at_means = lack_of_fit(condensed_, fixed, options_.seed, 0.05);
    consistent_ = at_means.f <= at_means.critical;
  }

  /// What each effect at a usual size would add to the calibrated model.
  std::vector<Direction> directions() const {
    std::vector<Direction> all;
    for (const Effect& effect : effects_) {
      Eigen::VectorXd x(base_.x.size() + static_cast<Eigen::Index>(effect.coordinates.size()));
      x.head(base_.x.size()) = base_.x;
      bool either_sign = false;
      for (std::size_t i = 0; i < effect.coordinates.size(); ++i) {
        const bool is_signed = !effect.coordinates[i].logarithmic;
        x[base_.x.size() + static_cast<Eigen::Index>(i)] = is_signed ? 1 : 0;
        either_sign = either_sign || is_signed;
      }
      const auto with = predict(bed_, soil_, {{effect}}, x);
      if (with) all.push_back({*with - base_.prediction, either_sign});
    }
    return all;
  }

  std::vector<SmallestDetectable> detectable() const {
    const FitProblem problem{bed_, soil_, discrepancy_, soil_free_};
    return smallest_detectable(problem, base_, effects_, found_.before.critical);
  }

  HeldOut held_out(const CorrectedModel& corrected) const {
    return hold_out(condensed_, soil_, base_, corrected, families_of(bed_), options_.threads);
  }

  void score() {
    const FitProblem problem{bed_, soil_, discrepancy_, soil_free_};
    const FitProblem wide{bed_, wide_soil_, discrepancy_, soil_free_};
    scored_ = score_candidates(
        problem, wide, effects_,
        {.threads = options_.threads, .stop = options_.stop, .progress = [&](double share) {
           tell("scoring what may be wrong", 0.15 + 0.7 * share);
         }});
    double parameters = -INFINITY, named = -INFINITY;
    for (const ScoredId& s : scored_) {
      if (s.id == "parameters") parameters = s.score;
      if (s.id != "none" && s.id != "parameters" && s.id != "unexplained") {
        named = std::max(named, s.score);
      }
    }
    rejected_ = unfit_ || stands_out_ || named > parameters + kClearEvidence;
    rank(!rejected_);
  }

  void rank(bool no_lack_of_fit) {
    weigh(scored_, no_lack_of_fit);
    const auto parameters =
        std::ranges::find_if(scored_, [](const ScoredId& s) { return s.id == "parameters"; });
    found_.ranking.clear();
    for (const ScoredId& s : scored_) {
      found_.ranking.push_back({s.id, s.probability, s.score - parameters->score});
    }
  }

  void decide() {
    if (!rejected_) {
      found_.verdict = consistent_ ? Verdict::kConsistent : Verdict::kParameters;
      correct_with(held_out({}), base_, {});
      return;
    }
    const FitProblem problem{bed_, soil_, discrepancy_, soil_free_};
    std::vector<NameClass> claimed = proven_one_by_one();
    const ScoredId* best = claimed.empty() ? nullptr : best_of(scored_, claimed);
    if (best != nullptr) {
      std::string doubt = objection(problem, best->fit);
      if (!doubt.empty() && another_holds(problem, claimed, std::string(best->id))) {
        claimed = proven_one_by_one();
        best = best_of(scored_, claimed);
        doubt.clear();
      }
      const std::vector<std::size_t> left = remainder_settings(problem, best->fit);
      const HeldOut proof = best_hold_out(condensed_, soil_, base_,
                                          {.fit = &best->fit, .remainder = left}, options_.threads);
      // soil tests are data that no family holds out: numbers that go back to them count
      const Eigen::Index soil = base_.x.size();
      const double pulls = base_.x.squaredNorm() - best->fit.x.head(soil).squaredNorm();
      const double back = std::max(pulls, 0.0);
      const double gain = gain_in_errors(bed_, proof.corrected, proof.calibrated, back);
      const double excess = std::max(proof.excess, 0.0);
      const double share = (proof.share_explained * excess + back) / std::max(excess + back, 1e-12);
      // noise alone moves the misfit by so much
      const double slack = std::sqrt(2.0 * static_cast<double>(bed_.size())) / (excess + back + 1);
      const bool proven = gain > kClearGain && share + slack > kWorthNaming;
      if (doubt.empty() && proven) {
        found_.claims = claims_of(problem, scored_, claimed, best->fit);
        const bool single = std::ranges::all_of(
            claimed, [](const NameClass& names) { return names.ids.size() == 1; });
        found_.verdict = single ? Verdict::kNamed : Verdict::kClass;
        correct_with(proof, best->fit, left);
        return;
      }
      found_.notes.push_back(fmt::format(
          "{} scores best but is not claimed: {}", best->id,
          !doubt.empty() ? doubt
                         : fmt::format("on held-out conditions it explains {:.0f} % of the excess "
                                       "misfit, {:.1f} standard errors",
                                       100 * share, gain)));
    }
    if (!unfit_) {
      // only a name's evidence spoke against the calibrated model, and the name does not hold
      found_.verdict = consistent_ ? Verdict::kConsistent : Verdict::kParameters;
      correct_with(held_out({}), base_, {});
      rank(true);
      return;
    }
    found_.verdict = Verdict::kUnexplained;
    describe_without_name();
  }

  /// Of two effects each must do its part on held-out conditions, whatever the kind of families:
  /// scores take what one mechanism's form leaves for a second mechanism. Pairs that do not are
  /// given up, and the rest is weighed anew.
  std::vector<NameClass> proven_one_by_one() {
    constexpr int kMostPairs = 3;
    for (int tried = 0;; ++tried) {
      std::vector<NameClass> claimed = claimed_names(scored_);
      if (claimed.size() < 2) return claimed;
      const auto idle = idle_effect(claimed);
      if (!idle) return claimed;
      found_.notes.push_back(fmt::format(
          "{} and {} score best together, but on held-out conditions {} adds {:.1f} standard "
          "errors only: the pair is given up",
          claimed[0].ids.front(), claimed[1].ids.front(), claimed[idle->effect].ids.front(),
          idle->gain));
      std::erase_if(scored_, [&](const ScoredId& s) {
        return is_of(s, claimed) || (tried + 1 == kMostPairs && s.id.find('+') != s.id.npos);
      });
      rank(false);
    }
  }

  /// What speaks against the best of a class need not speak against its other names, nor against
  /// it with a second effect beside it. Gives up the best where a claim that shares a name with the
  /// one before is made then and nothing speaks against it.
  bool another_holds(const FitProblem& problem, const std::vector<NameClass>& refuted,
                     const std::string& best) {
    const std::vector<ScoredId> before = scored_;
    const std::size_t notes = found_.notes.size();
    std::erase_if(scored_, [&](const ScoredId& s) { return s.id == best; });
    rank(false);
    const std::vector<NameClass> claimed = proven_one_by_one();
    const ScoredId* other = claimed.empty() ? nullptr : best_of(scored_, claimed);
    const auto was_named = [&](const Effect& effect) {
      return std::ranges::any_of(refuted, [&](const NameClass& names) {
        return std::ranges::count(names.ids, effect.id) > 0;
      });
    };
    if (other != nullptr && std::ranges::any_of(other->fit.candidate.effects, was_named) &&
        objection(problem, other->fit).empty()) {
      return true;
    }
    scored_ = before;
    found_.notes.resize(notes);
    rank(false);
    return false;
  }

  struct IdleEffect {
    std::size_t effect = 0;
    double gain = 0;  // standard errors
  };

  /// The effect of a pair without which held-out conditions are predicted as well.
  std::optional<IdleEffect> idle_effect(const std::vector<NameClass>& claimed) const {
    const ScoredId* pair = best_of(scored_, claimed);
    if (pair == nullptr) return std::nullopt;
    const FitProblem problem{bed_, soil_, discrepancy_, soil_free_};
    const auto proof = [&](const CandidateFit& fit, const Families& families) {
      const CorrectedModel model{.fit = &fit, .remainder = remainder_settings(problem, fit)};
      return hold_out(condensed_, soil_, base_, model, families, options_.threads).corrected;
    };
    std::array<double, 2> gain{-INFINITY, -INFINITY};
    for (const Families& families : all_families(bed_)) {
      const Eigen::VectorXd both = proof(pair->fit, families);
      for (const std::size_t left_out : {0, 1}) {
        const ScoredId* single = best_of(scored_, {claimed[1 - left_out]});
        gain[left_out] = single == nullptr
                             ? INFINITY
                             : std::max(gain[left_out],
                                        gain_in_errors(bed_, both, proof(single->fit, families)));
      }
    }
    const std::size_t least = gain[0] < gain[1] ? 0 : 1;
    if (gain[least] > kClearGain) return std::nullopt;
    return IdleEffect{least, gain[least]};
  }

  /// A surface over the calibrated soil, or over the soil that a discrepancy leaves to be found:
  /// the one that does better on held-out conditions.
  void describe_without_name() {
    const FitProblem problem{bed_, soil_, discrepancy_, soil_free_};
    const auto unexplained =
        std::ranges::find_if(scored_, [](const ScoredId& s) { return s.id == "unexplained"; });
    const std::vector<std::size_t> over_base = remainder_settings(problem, base_);
    const HeldOut on_base = held_out({.remainder = over_base});
    if (unexplained != scored_.end()) {
      const CandidateFit& fit = unexplained->fit;
      const std::vector<std::size_t> over_fit = remainder_settings(problem, fit);
      const HeldOut on_fit = held_out({.fit = &fit, .remainder = over_fit});
      if (on_fit.share_explained > on_base.share_explained) {
        correct_with(on_fit, fit, over_fit);
        return;
      }
    }
    correct_with(on_base, base_, over_base);
  }

  /// Takes a fit and the remainder added to it (settings; empty: none) for the corrected model.
  void correct_with(const HeldOut& proof, const CandidateFit& fit,
                    const std::vector<std::size_t>& settings) {
    if (&fit != &base_ || !settings.empty()) {
      const std::string reason = no_better_than_calibrated(bed_, proof);
      if (!reason.empty()) {
        found_.notes.push_back("the corrected model is the calibrated one: " + reason);
        correct_with(hold_out(condensed_, soil_, base_, {}, proof.families, options_.threads),
                     base_, {});
        return;
      }
    }
    const FitProblem problem{bed_, soil_, discrepancy_, soil_free_};
    found_.fit = proof.fit;
    found_.held_out_by = proof.families.by;
    found_.share_explained = proof.share_explained;
    FitRemainder remainder = remainder_of(fit);
    Eigen::VectorXd corrected = fit.prediction;
    found_.corrected_model = {.variant = bed_.setup.variant,
                              .wheel = bed_.setup.wheel,
                              .soil = soil_of(bed_, soil_, fit.candidate, fit.x),
                              .gravity_mps2 = bed_.setup.gravity_mps2};
    found_.corrected_soil = {.mean = found_.corrected_model.soil,
                             .standard_deviation = bed_.setup.soil.standard_deviation};
    for (std::size_t i = 0; i < soil_.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      const SoilParameter& p = soil_parameters()[soil_[i].parameter];
      found_.soil[i].corrected = estimate(fit, k, p.file_unit);
      found_.soil[i].corrected_pull = fit.x[k];
      found_.corrected_soil.standard_deviation.*p.member =
          soil_[i].coordinate.spread * std::sqrt(fit.evidence.covariance(k, k));
    }
    add_mechanisms(fit);
    if (!settings.empty()) {
      found_.corrected_model.generic =
          unnamed_correction(problem, fit, settings, proof.remainder_share);
      // one that adds nothing would only make the rest of the world `outside_correction`
      if (found_.corrected_model.generic->nodes.empty()) found_.corrected_model.generic.reset();
      for (std::size_t c = 0; c < bed_.channels.size(); ++c) {
        const Eigen::Index from = bed_.offset(c), n = bed_.channels[c].mean.size();
        const ChannelCovariance& covariance = discrepancy_.at(c, settings[c]);
        if (covariance.discrepancy.size() == 0) continue;
        corrected.segment(from, n) += proof.remainder_share[c] * covariance.discrepancy *
                                      covariance.factor.solve(remainder.residual.segment(from, n));
      }
      remainder.residual = measured_ - corrected;
    }
    if (!found_.claims.empty() || !settings.empty()) {
      found_.after = lack_of_fit(condensed_, remainder, options_.seed);
    }
    list_residuals(proof, corrected);
  }

  /// Faults of instruments are no part of a model of the wheel.
  void add_mechanisms(const CandidateFit& fit) {
    auto next = static_cast<Eigen::Index>(soil_.size());
    for (const Effect& effect : fit.candidate.effects) {
      const auto size = static_cast<Eigen::Index>(effect.coordinates.size());
      if (!is_instrument(effect.id)) {
        found_.corrected_model.mechanisms.push_back(
            mechanism_at(effect, fit.x.segment(next, size)));
      }
      next += size;
    }
  }

  void list_residuals(const HeldOut& proof, const Eigen::VectorXd& corrected) {
    const Eigen::VectorXd means = *predict(bed_, soil_, {}, Eigen::VectorXd::Zero(base_.x.size()));
    for (std::size_t c = 0; c < bed_.channels.size(); ++c) {
      const ChannelData& data = bed_.channels[c];
      for (std::size_t i = 0; i < data.conditions.size(); ++i) {
        const Eigen::Index row = bed_.offset(c) + static_cast<Eigen::Index>(i);
        for (const std::size_t run : bed_.conditions[data.conditions[i]].runs) {
          const double y = condensed_.adjusted[c][run];
          if (!std::isfinite(y)) continue;
          found_.residuals.push_back(
              {.run = run,
               .channel = data.channel,
               .measured = y,
               .noise = run_deviation(condensed_.noise[c], y),
               .baseline = means[row],
               .calibrated = base_.prediction[row],
               .corrected = corrected[row],
               .held_out = proof.corrected[row],
               .held_out_standard_deviation = proof.corrected_deviation[row]});
        }
      }
    }
  }

  /// Between the names of the claim, or else the likeliest.
  std::vector<Experiment> experiments() const {
    constexpr std::size_t kMostRivals = 4;
    std::vector<ScoredId> rivals;
    for (const ScoredId& s : scored_) {
      if (rivals.size() == kMostRivals) break;
      if (s.id == "none" || s.id == "parameters" || s.id == "unexplained") continue;
      rivals.push_back(s);
    }
    const FitProblem problem{bed_, soil_, discrepancy_, soil_free_};
    return next_experiments(problem, rivals);
  }

  const DiagnosisOptions& options_;
  CondensedRecording condensed_;
  const TestBed& bed_;
  std::vector<SoilCoordinate> soil_, wide_soil_;
  Discrepancy discrepancy_;
  Eigen::VectorXd measured_;
  std::vector<Effect> effects_;
  CandidateFit base_;
  Eigen::MatrixXd soil_free_;
  std::vector<ScoredId> scored_;
  bool stands_out_ = false;  // the residual lies along some effect farther than noise goes
  bool unfit_ = false;       // lack of fit, or soil numbers that calibration pulled too far
  bool rejected_ = false;    // that, or a name far better than calibration alone
  bool consistent_ = false;
  Diagnosis found_;
};

}  // namespace

Diagnosis diagnose(const Recording& recording, const DiagnosisSetup& setup,
                   const DiagnosisOptions& options) {
  return Diagnosing(recording, setup, options).run();
}

}  // namespace regoplan
