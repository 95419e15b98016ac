#include "diagnosis/names/partial_claim.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/names/claim_by_shares.h"
#include "diagnosis/recording/thresholds.h"

namespace regoplan {
namespace {

constexpr std::size_t kMostNames = 3;

std::vector<double> weights_of(const std::vector<CappedName>& names) {
  std::vector<double> weights;
  double top = -INFINITY;
  for (const CappedName& name : names) {
    if (!name.refused) top = std::max(top, posterior_nats(name));
  }
  for (const CappedName& name : names) {
    weights.push_back(name.refused ? 0
                                   : std::exp((posterior_nats(name) - top) / temperature_of(top)));
  }
  return weights;
}

double probability_of(const std::vector<CappedName>& names, const std::vector<std::string>& ids) {
  const std::vector<double> weights = weights_of(names);
  double within = 0, whole = 0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    whole += weights[i];
    if (std::ranges::find(ids, names[i].id) != ids.end()) within += weights[i];
  }
  return whole > 0 ? within / whole : 0;
}

/// The claim for the last effect of a fit.
Claim claim_for_last(const CalibratedRecording& calibrated, const CandidateFit& fit,
                     const std::vector<std::string>& ids) {
  const FitProblem problem = calibrated.problem();
  const std::string& id = fit.candidate.effects.back().id;
  NameClass names{.ids = {id}};
  for (const std::string& other : ids) {
    if (other != id) names.ids.push_back(other);
  }
  std::vector<Claim> claims = claims_of(problem, {}, {names}, fit);
  Claim claim = claims.front();
  claim.channels = channels_of(problem, fit, fit.candidate.effects.size() - 1);
  return claim;
}

std::vector<std::string> ids_near(const std::vector<CappedName>& names, double gain_nats) {
  std::vector<std::string> ids;
  for (const CappedName& name : names) {
    if (name.gain_nats > gain_nats - Thresholds::kOverOthers_nats) ids.push_back(name.id);
  }
  return ids;
}

/// Why a name may not stand, by itself or in a class; empty where it may.
std::string objection_to(const CalibratedRecording& calibrated, const CappedContest& contest,
                         const CappedName& name, int threads) {
  if (name.gain_nats < Thresholds::kOverRemainder_nats) {
    return fmt::format("it gains {:.1f} nats over an unnamed remainder", name.gain_nats);
  }
  std::string doubt = objection(calibrated.problem(), name.fit);
  if (!doubt.empty()) return doubt;
  const NameShare share = name_share(calibrated, name.fit, threads);
  if (share.share.low < Thresholds::kWorthANameAlone) {
    return fmt::format("held out it explains {:.0f} % of the excess misfit only",
                       100 * share.share.low);
  }
  if (!extrapolates_better(calibrated, name.fit, contest.alone_settings(), threads)) {
    return "a nameless surface extrapolates better";
  }
  return "";
}

}  // namespace

std::vector<ScoredCandidate> capped_ranking(const std::vector<CappedName>& names, double chance_p) {
  std::vector<ScoredCandidate> ranking;
  const std::vector<double> weights = weights_of(names);
  double whole = 0;
  for (const double weight : weights) whole += weight;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const double within = whole > 0 ? weights[i] / whole : 0;
    ranking.push_back({names[i].id, (1 - chance_p) * within, names[i].gain_nats});
  }
  ranking.push_back({Account{Account::Kind::kUnexplained}.id(), whole > 0 ? chance_p : 1, 0});
  ranking.push_back({Account{Account::Kind::kNone}.id(), 0, 0});
  ranking.push_back({Account{Account::Kind::kParameters}.id(), 0, 0});
  std::ranges::stable_sort(ranking, std::greater{}, &ScoredCandidate::probability);
  return ranking;
}

std::string likelier_than(const std::vector<std::string>& ids,
                          const std::vector<ScoredCandidate>& ranking) {
  constexpr std::size_t kNamed = 3;
  double claimed = 0;
  std::vector<std::string> others;
  for (const ScoredCandidate& one : ranking) {
    if (std::ranges::find(ids, one.id) != ids.end()) {
      claimed += one.probability;
    } else if (others.size() < kNamed) {
      others.push_back(one.id);
    }
  }
  if (claimed > Thresholds::kLikelierThanAll) return "";
  return fmt::format("{} may stand, and all else together is likelier: {}", fmt::join(ids, " or "),
                     fmt::join(others, ", "));
}

PartialClaim first_claim(const CalibratedRecording& calibrated,
                         const std::vector<CappedName>& names, const std::vector<std::string>& ids,
                         double chance_p, int threads) {
  const auto find = [&](const std::string& id) {
    return std::ranges::find(names, id, &CappedName::id);
  };
  PartialClaim result{.fit = find(ids.front())->fit};
  Claim claim = claim_for_last(calibrated, result.fit, ids);
  claim.evidence_nats = find(ids.front())->gain_nats;
  claim.over_unexplained_nats = find(ids.front())->over_unexplained_nats;
  claim.probability = (1 - chance_p) * probability_of(names, ids);
  for (const std::string& id : ids) {
    claim.member_shares[id] = name_share(calibrated, find(id)->fit, threads).share;
    result.members.push_back(find(id)->fit);
  }
  claim.share = claim.member_shares[ids.front()];
  result.claims.push_back(std::move(claim));
  result.steps.push_back(result.fit);
  return result;
}

std::string objection_to_class(const std::vector<std::string>& ids, bool leave_nothing) {
  if (ids.size() > Thresholds::kLargestClass) {
    return fmt::format("{} names fit alike: {}", ids.size(), fmt::join(ids, ", "));
  }
  const bool mixed =
      std::ranges::any_of(ids, is_instrument) && !std::ranges::all_of(ids, is_instrument);
  if (!mixed || leave_nothing) return "";
  return fmt::format("names of wheel and instrument fit alike and leave a part unexplained: {}",
                     fmt::join(ids, ", "));
}

double remainder_share(const std::vector<Claim>& claims) {
  if (std::ranges::none_of(claims, [](const Claim& claim) { return claim.share.has_value(); }))
    return 0;
  double explained = 0;
  for (const Claim& claim : claims) explained += claim.share ? claim.share->explained : 0;
  return std::clamp(1 - explained, 0.0, 1.0);
}

std::vector<NameStep> steps_of(const CalibratedRecording& calibrated, const PartialClaim& claim,
                               int threads) {
  std::vector<NameStep> steps;
  for (const CandidateFit& fit : claim.steps) {
    const HeldOut held = calibrated.held_out({.fit = &fit}, threads);
    steps.push_back({fit.candidate.effects.back().id, held.fit, held.share_explained});
  }
  return steps;
}

void add_further_names(const CalibratedRecording& calibrated, const CappedContest& contest,
                       const std::vector<Effect>& effects, double gain_nats, int threads,
                       PartialClaim& claim) {
  while (claim.claims.size() < kMostNames) {
    std::vector<Effect> further = effects;
    std::erase_if(further, [&](const Effect& e) {
      return is_instrument(e.id) ||
             std::ranges::any_of(claim.claims, [&](const Claim& c) { return c.is_of(e.id); });
    });
    const auto names = contest.score(further, &claim.fit, threads);
    if (names.empty()) return;
    const CappedName& best = names.front();
    if (best.gain_nats - gain_nats < Thresholds::kOverRemainder_nats) return;
    if (!objection(calibrated.problem(), best.fit).empty()) return;
    const NameShare added = added_share(calibrated, best.fit, claim.fit, threads);
    if (added.share.low < Thresholds::kWorthAnother ||
        added.gain_in_errors < Thresholds::kClear_errors || added.worsens())
      return;
    const std::vector<std::string> ids = ids_near(names, best.gain_nats);
    if (ids.size() > Thresholds::kLargestClass) return;
    Claim next = claim_for_last(calibrated, best.fit, ids);
    next.evidence_nats = best.gain_nats - gain_nats;
    next.probability = probability_of(names, ids);
    next.share = added.share;
    for (const CappedName& name : names) {
      if (std::ranges::find(ids, name.id) == ids.end()) continue;
      next.member_shares[name.id] = added_share(calibrated, name.fit, claim.fit, threads).share;
    }
    claim.claims.push_back(std::move(next));
    claim.fit = best.fit;
    claim.steps.push_back(best.fit);
    gain_nats = best.gain_nats;
  }
}

namespace {

/// What each name of a claim gains over those before it, beside a capped remainder.
void add_evidence(const CappedContest& contest, int threads, PartialClaim& claim) {
  double before = 0;
  for (std::size_t k = 0; k < claim.claims.size(); ++k) {
    const CandidateFit* beside = k == 0 ? nullptr : &claim.steps[k - 1];
    const auto name = contest.score({claim.steps[k].candidate.effects.back()}, beside, threads);
    const double gain = name.empty() ? before : name.front().gain_nats;
    claim.claims[k].evidence_nats = gain - before;
    before = gain;
  }
}

/// A class where no name stands by its evidence.
std::optional<PartialClaim> class_by_shares(const CalibratedRecording& calibrated,
                                            const CappedContest& contest,
                                            const std::vector<Effect>& effects,
                                            const std::vector<CappedName>& names,
                                            std::uint64_t seed, int threads) {
  auto claim = claim_by_shares(calibrated, effects, threads);
  if (!claim) return std::nullopt;
  add_evidence(contest, threads, *claim);
  if (claim->claims.front().evidence_nats < Thresholds::kOverRemainder_nats) return std::nullopt;
  const double p = chance_of_share(calibrated, contest, names, seed);
  for (Claim& one : claim->claims) one.probability = 1 - p;
  return claim;
}

/// Shares tell the names of a class no further apart: each is as likely as another.
std::vector<ScoredCandidate> ranking_of_class(const Claim& claim,
                                              const std::vector<CappedName>& names) {
  const auto members = static_cast<double>(
      std::ranges::count_if(names, [&](const CappedName& name) { return claim.is_of(name.id); }));
  std::vector<ScoredCandidate> ranking = capped_ranking({}, 1);
  ranking.front().probability = 1 - claim.probability;
  for (const CappedName& name : names) {
    ranking.push_back(
        {name.id, claim.is_of(name.id) ? claim.probability / members : 0, name.gain_nats});
  }
  std::ranges::stable_sort(ranking, std::greater{}, &ScoredCandidate::probability);
  return ranking;
}

/// What stands by its evidence beside a remainder. A sensor's fault that is refused for its size
/// may be there all the same: what does far worse does not take its place.
/// \param names marked where they are refused
PartialDecision by_evidence(const CalibratedRecording& calibrated, const CappedContest& contest,
                            std::vector<CappedName>& names, const std::vector<double>& by_chance,
                            const std::vector<Effect>& effects, int threads) {
  PartialDecision decision;
  // what stands by itself, then what comes near the best of that
  std::vector<std::string> ids;
  double top = 0, p = 1;
  double refused_fault = 0;
  for (CappedName& name : names) {
    if (name.gain_nats <
        std::max(Thresholds::kOverRemainder_nats, top - Thresholds::kOverOthers_nats))
      break;
    const std::string doubt = objection_to(calibrated, contest, name, threads);
    if (!doubt.empty()) {
      name.refused = true;
      if (is_instrument(name.id)) refused_fault = std::max(refused_fault, name.gain_nats);
      if (ids.empty())
        decision.refused +=
            fmt::format("{}{}: {}", decision.refused.empty() ? "" : "; ", name.id, doubt);
      continue;
    }
    if (ids.empty()) {
      top = name.gain_nats;
      p = chance_of(by_chance, name.over_unexplained_nats);
    }
    ids.push_back(name.id);
  }
  decision.ranking = capped_ranking(names, p);
  if (ids.empty()) return decision;
  if (refused_fault - top > Thresholds::kOverOthers_nats) return decision;
  if (p > (ids.size() == 1 ? Thresholds::kByChance_p : Thresholds::kLikelierThanAll)) {
    decision.refused =
        fmt::format("{}: nameless worlds let some name do as well with a probability of {:.2f}",
                    fmt::join(ids, " or "), p);
    return decision;
  }
  decision.refused = objection_to_class(ids, false);
  if (!decision.refused.empty()) return decision;
  decision.claim = first_claim(calibrated, names, ids, p, threads);
  add_further_names(calibrated, contest, effects, top, threads, *decision.claim);
  return decision;
}

}  // namespace

PartialDecision decide_partly(const CalibratedRecording& calibrated,
                              const std::vector<Effect>& effects, std::uint64_t seed, int threads) {
  const CappedContest contest(calibrated);
  std::vector<CappedName> names = contest.score(effects, nullptr, threads);
  if (names.empty()) return {.ranking = capped_ranking({}, 1)};
  const std::vector<double> by_chance = nats_by_chance(calibrated, contest, names, seed, threads);
  PartialDecision decision = by_evidence(calibrated, contest, names, by_chance, effects, threads);
  decision.chance_nats = reached_by_chance(by_chance);
  if (decision.claim) return decision;
  decision.claim = class_by_shares(calibrated, contest, effects, names, seed, threads);
  if (decision.claim) {
    decision.ranking = ranking_of_class(decision.claim->claims.front(), names);
  }
  return decision;
}

}  // namespace regoplan
