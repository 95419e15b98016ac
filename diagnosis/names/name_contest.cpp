#include "diagnosis/names/name_contest.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "diagnosis/checks/bed_memory.h"
#include "diagnosis/fit/unnamed_correction.h"
#include "diagnosis/names/correction.h"
#include "diagnosis/names/name_share.h"
#include "diagnosis/recording/thresholds.h"

namespace regoplan {
namespace {

double log_odds(double probability) {
  return std::log(probability / std::max(1 - probability, 1e-12));
}

/// Whether an effect is sure enough by its probability and by what it adds held out together.
bool is_borne_out(double probability, double errors) {
  const double needed =
      log_odds(Thresholds::kSure) + Thresholds::kClear_errors * Thresholds::kClear_errors / 2;
  return errors > Thresholds::kLeastOfOne_errors &&
         log_odds(probability) + errors * errors / 2 > needed;
}

/// What a claim explains on held-out conditions, and of the pulls on the soil numbers.
struct Worth {
  double gain = 0;   ///< standard errors
  double share = 0;  ///< of the excess misfit
  double slack = 0;  ///< noise alone moves that share by so much

  /// \param probability of all that is claimed
  bool proves(double probability) const {
    return is_borne_out(probability, gain) && share + slack > Thresholds::kWorthCorrecting;
  }
};

Worth worth_of(const CalibratedRecording& calibrated, const CandidateFit& fit,
               const HeldOut& proof) {
  const Eigen::VectorXd& base = calibrated.base().x;
  // Soil tests are data that no family holds out: numbers that go back to them count.
  const double back = std::max(base.squaredNorm() - fit.x.head(base.size()).squaredNorm(), 0.0);
  const double excess = std::max(proof.excess, 0.0);
  const auto size = static_cast<double>(calibrated.bed().size());
  return {.gain = gain_in_errors(calibrated.bed(), proof.corrected, proof.calibrated, back),
          .share = (proof.share_explained * excess + back) / std::max(excess + back, 1e-12),
          .slack = std::sqrt(2.0 * size) / (excess + back + 1)};
}

/// What names leave on held-out conditions when nothing stands beside them; fitted with a remainder
/// they may leave more to it than they have to.
struct Leftover {
  double share = INFINITY;  ///< of the excess misfit, by the kind of families that leaves least
  double deviations = 0;    ///< of noise and of what the rest leaves open, there
  /// By which a remainder predicts better in standard errors, or deviations of noise that are left
  /// where these are fewer: most over kinds of families.
  double clear = -INFINITY;

  bool is_worth_correcting() const {
    return share > Thresholds::kWorthCorrecting && deviations > Thresholds::kClear_errors;
  }
};

/// \param names fitted alone
Leftover leftover_of(const CalibratedRecording& calibrated, const CandidateFit& names,
                     int threads) {
  const TestBed& bed = calibrated.bed();
  const FitProblem problem = calibrated.problem();
  const std::vector<std::size_t> remainder = remainder_settings(problem, names);
  Leftover left;
  for (const Families& families : all_families(bed)) {
    const HeldOut alone = calibrated.held_out({.fit = &names}, families, threads);
    const HeldOut with =
        calibrated.held_out({.fit = &names, .remainder = remainder}, families, threads);
    const double share = 1 - alone.share_explained;
    const double deviations = (share * std::max(alone.excess, 0.0) - alone.expected.mean) /
                              alone.expected.standard_deviation;
    left.clear = std::max(
        left.clear, std::min(gain_in_errors(bed, with.corrected, alone.corrected), deviations));
    if (share >= left.share) continue;
    left.share = share;
    left.deviations = deviations;
  }
  return left;
}

/// The name of a class that scores best by itself, given up or not: something may speak against it
/// and a second effect beside it add nothing all the same.
const ScoredId* likeliest_single(const std::vector<ScoredId>& scored, const NameClass& names) {
  const ScoredId* best = nullptr;
  for (const ScoredId& s : scored) {
    if (is_of(s, {names}) && (best == nullptr || s.score > best->score)) best = &s;
  }
  return best;
}

bool is_known_exactly(const CandidateFit& fit) {
  return std::ranges::all_of(fit.candidate.effects,
                             [](const Effect& effect) { return has_one_form(effect); });
}

}  // namespace

std::optional<ProvenClaim> NameContest::decide() {
  std::vector<NameClass> claimed = proven_one_by_one();
  const ScoredId* best = claimed.empty() ? nullptr : best_of(scored_, claimed);
  if (best == nullptr) return std::nullopt;
  const FitProblem problem = calibrated_.problem();
  std::string doubt = doubt_about(best->fit);
  if (!doubt.empty() && another_holds(claimed, std::set(best->account.effects))) {
    claimed = proven_one_by_one();
    best = best_of(scored_, claimed);
    doubt.clear();
  }
  const std::vector<std::size_t> left = remainder_settings(problem, best->fit);
  HeldOut proof = proof_of(best->fit, left);
  const Worth worth = worth_of(calibrated_, best->fit, proof);
  if (doubt.empty() && !worth.proves(claimed.front().probability)) {
    doubt = fmt::format(
        "on held-out conditions it explains {:.0f} % of the excess misfit, {:.1f} standard errors",
        100 * worth.share, worth.gain);
  }
  if (doubt.empty()) {
    const CandidateFit fit = best->fit;
    const Leftover leftover = leftover_of(calibrated_, fitted_alone(calibrated_, fit), threads_);
    const bool is_rough = leftover.is_worth_correcting();
    if (is_rough && is_known_exactly(fit)) {
      doubt = fmt::format("what it does is known exactly, and leaves {:.0f} % of the excess misfit",
                          100 * leftover.share);
    } else {
      add_names_alike(problem, scored_, *best, claimed);
      if (is_rough) share_with_unlisted(claimed);
      return ProvenClaim{std::move(claimed), fit, left, std::move(proof)};
    }
  }
  notes_.push_back(fmt::format("{} scores best but is not claimed: {}", best->id(), doubt));
  return std::nullopt;
}

HeldOut NameContest::proof_of(const CandidateFit& fit,
                              const std::vector<std::size_t>& remainder) const {
  return best_hold_out(calibrated_.recording(), calibrated_.soil(), calibrated_.base(),
                       {.fit = &fit, .remainder = remainder}, threads_);
}

/// Of two effects each must do its part on held-out conditions, whatever the kind of families:
/// scores take what one mechanism's form leaves for a second mechanism. A pair that does not is
/// given up, and less likely pairs with one of its names; the rest is weighed anew.
std::vector<NameClass> NameContest::proven_one_by_one() {
  constexpr int kMostPairs = 5;
  for (int tried = 0;; ++tried) {
    std::vector<NameClass> claimed = claimed_names(scored_);
    if (claimed.size() < 2) return claimed;
    const auto idle = idle_effect(claimed);
    if (!idle) return claimed;
    const ScoredId idle_pair = *best_of(scored_, claimed);
    const auto shares_a_name = [&](const ScoredId& other) {
      return std::ranges::any_of(other.account.effects, [&](const std::string& id) {
        return idle_pair.account.effects.contains(id);
      });
    };
    notes_.push_back(fmt::format(
        "{} and {} score best together, by {:.1f} nats, but {}: the pair is given up",
        claimed[0].ids.front(), claimed[1].ids.front(), idle->over_one_nats, idle->why));
    for (ScoredId& s : scored_) {
      if (s.account.effects.size() < 2) continue;
      const bool less_likely =
          s.score < idle_pair.score - Thresholds::kAsGood_nats && shares_a_name(s);
      s.given_up = s.given_up || less_likely || tried + 1 == kMostPairs ||
                   s.account.effects == idle_pair.account.effects;
    }
    weigh(scored_, plain_);
  }
}

/// Names that leave as much as is worth a correction may well stand in for something on no list.
/// What is known to the last term leaves nothing: it is not claimed there (decide).
void NameContest::share_with_unlisted(std::vector<NameClass>& claimed) {
  for (NameClass& names : claimed) names.probability *= Thresholds::kRoughName;
  double given = 0;
  for (ScoredId& s : scored_) {
    if (s.account.kind != Account::Kind::kEffects) continue;
    given += (1 - Thresholds::kRoughName) * s.probability;
    s.probability *= Thresholds::kRoughName;
  }
  for (ScoredId& s : scored_) {
    if (s.account.kind == Account::Kind::kUnexplained) s.probability += given;
  }
  std::ranges::stable_sort(scored_, std::greater{}, &ScoredId::probability);
}

/// What speaks against it: its own numbers, or a lack of fit that it leaves. Other effects act in
/// forms that nobody knows and may leave one.
std::string NameContest::doubt_about(const CandidateFit& fit) const {
  std::string doubt = objection(calibrated_.problem(), fit, Thresholds::kPlausibleFault);
  if (doubt.empty() &&
      deviations_of_memory(calibrated_.problem(), fit) > Thresholds::kMemory_deviations) {
    doubt = "what it leaves follows the slip of the run before";
  }
  if (!doubt.empty()) return doubt;
  if (!is_known_exactly(fit)) return doubt_about_fault(fit);
  const CandidateFit alone = fitted_alone(calibrated_, fit);
  const LackOfFit left =
      lack_of_fit(calibrated_.recording(), calibrated_.remainder_of(alone), seed_,
                  Thresholds::kLackOfFit_p, tails_of(calibrated_.recording()));
  if (left.f > left.critical) {
    return fmt::format("what it does is known exactly, and leaves a lack of fit (p = {:.2g})",
                       left.p_value);
  }
  const Leftover held_out = leftover_of(calibrated_, alone, threads_);
  if (held_out.clear < Thresholds::kBesideExact_deviations) return "";
  return fmt::format(
      "what it does is known exactly, and held-out conditions show a remainder beside it by {:.1f} "
      "standard deviations",
      held_out.clear);
}

/// An instrument is easily blamed for physics on no list: beside a fault that changes in time, or
/// one that is claimed with a mechanism, a remainder must leave no lack of fit.
std::string NameContest::doubt_about_fault(const CandidateFit& fit) const {
  const bool blames_instrument = std::ranges::any_of(
      fit.candidate.effects, [](const Effect& effect) { return is_instrument(effect.id); });
  if (!blames_instrument) return "";
  const std::vector<std::size_t> remainder = remainder_settings(calibrated_.problem(), fit);
  const Correction correction =
      correction_by(calibrated_, fit, remainder, proof_of(fit, remainder), threads_);
  const LackOfFit left = lack_of_fit(calibrated_.recording(), correction.remainder, seed_,
                                     Thresholds::kBeyondDoubt_p, tails_of(calibrated_.recording()));
  if (left.p_value >= Thresholds::kBeyondDoubt_p) return "";
  return fmt::format(
      "it blames an instrument, and a remainder beside it leaves a lack of fit "
      "(p = {:.2g})",
      left.p_value);
}

/// What speaks against the best of a class need not speak against its other names, nor against
/// it with a second effect beside it. Gives up the best where a claim that shares a name with the
/// one before is made then and nothing speaks against it.
bool NameContest::another_holds(const std::vector<NameClass>& refuted,
                                const std::set<std::string>& best) {
  const std::vector<ScoredId> before = scored_;
  const std::size_t notes = notes_.size();
  for (ScoredId& s : scored_) s.given_up = s.given_up || s.account.effects == best;
  weigh(scored_, plain_);
  const std::vector<NameClass> claimed = proven_one_by_one();
  const ScoredId* other = claimed.empty() ? nullptr : best_of(scored_, claimed);
  const auto was_named = [&](const Effect& effect) {
    return std::ranges::any_of(refuted, [&](const NameClass& names) {
      return std::ranges::count(names.ids, effect.id) > 0;
    });
  };
  if (other != nullptr && std::ranges::any_of(other->fit.candidate.effects, was_named) &&
      doubt_about(other->fit).empty()) {
    return true;
  }
  scored_ = before;
  notes_.resize(notes);
  weigh(scored_, plain_);
  return false;
}

/// What a second effect must gain over the other alone. Where that one's form is a proxy, what it
/// leaves of its own effect grows with it, and another effect takes part of it.
double NameContest::least_over_nats(const ScoredId& single) const {
  const double gain_nats = single.score - scored_as(Account::Kind::kParameters, scored_).score;
  const double left_nats =
      is_known_exactly(single.fit) ? 0 : Thresholds::kFormShare * std::max(gain_nats, 0.0);
  return std::min(Thresholds::kSecond_nats + left_nats, Thresholds::kClearSecond_nats);
}

/// The effect of a pair that does not do its part: it gains no more over the other alone than that
/// one's form may leave, or held-out conditions are predicted as well without it, unless the whole
/// recording says so clearly that it is there that it only must not spoil them: a remainder beside
/// the other name may predict there what it does.
std::optional<NameContest::IdleEffect> NameContest::idle_effect(
    const std::vector<NameClass>& claimed) const {
  const ScoredId* pair = best_of(scored_, claimed);
  if (pair == nullptr) return std::nullopt;
  const std::array<const ScoredId*, 2> alone{likeliest_single(scored_, claimed[1]),
                                             likeliest_single(scored_, claimed[0])};
  const auto over_nats = [&](std::size_t effect) {
    return alone.at(effect) == nullptr ? INFINITY : pair->score - alone.at(effect)->score;
  };
  const auto missing_nats = [&](std::size_t effect) {
    const ScoredId* other = alone.at(effect);
    return other == nullptr ? -INFINITY : least_over_nats(*other) - over_nats(effect);
  };
  const std::size_t lesser = missing_nats(0) > missing_nats(1) ? 0 : 1;
  if (missing_nats(lesser) > 0) {
    return IdleEffect{over_nats(lesser), fmt::format("{:.1f} nats may be left by the form of {}",
                                                     least_over_nats(*alone.at(lesser)),
                                                     claimed[1 - lesser].ids.front())};
  }
  const auto proof = [&](const CandidateFit& fit, const Families& families) {
    const CorrectedModel model{.fit = &fit,
                               .remainder = remainder_settings(calibrated_.problem(), fit)};
    return calibrated_.held_out(model, families, threads_).corrected;
  };
  std::array<double, 2> gain{-INFINITY, -INFINITY};
  for (const Families& families : families_of_all_columns(calibrated_.bed())) {
    const Eigen::VectorXd both = proof(pair->fit, families);
    for (const std::size_t effect : {0, 1}) {
      gain.at(effect) =
          alone.at(effect) == nullptr
              ? INFINITY
              : std::max(gain.at(effect), gain_in_errors(calibrated_.bed(), both,
                                                         proof(alone.at(effect)->fit, families)));
    }
  }
  const std::size_t least = gain[0] < gain[1] ? 0 : 1;
  const bool clear = over_nats(least) > Thresholds::kClearSecond_nats &&
                     gain.at(least) > -Thresholds::kLeastOfOne_errors;
  if (clear || is_borne_out(claimed[1].probability, gain.at(least))) return std::nullopt;
  return IdleEffect{over_nats(least),
                    fmt::format("on held-out conditions {} adds {:.1f} standard errors only",
                                claimed[least].ids.front(), gain.at(least))};
}

}  // namespace regoplan
