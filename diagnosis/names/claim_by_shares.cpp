#include "diagnosis/names/claim_by_shares.h"

#include <algorithm>
#include <iterator>
#include <set>

#include "diagnosis/names/names_alone.h"
#include "diagnosis/recording/thresholds.h"

namespace regoplan {
namespace {

constexpr std::size_t kMostClasses = 3;
/// Sequences of names that are followed on.
constexpr std::size_t kBeam = 2;

/// Names, one of each class in turn, and what all of them explain together.
struct NameSequence {
  PartialClaim claim;
  NameShare together;
  std::size_t not_the_best = 0;  ///< classes that are not led by the best of them
  /// What counts: a name, and one in the place of the best of its class, must be worth it.
  double worth() const {
    return together.share.low -
           Thresholds::kWorthAnother * static_cast<double>(claim.claims.size() + not_the_best);
  }
};

/// Names beside those that are there, without their likes.
std::vector<Effect> further_names(const std::vector<Effect>& effects,
                                  const std::vector<Claim>& claims) {
  std::set<std::string> taken;
  for (const Claim& claim : claims) taken.insert(claim.id);
  std::vector<Effect> further = effects;
  std::erase_if(further, [&](const Effect& effect) {
    return is_instrument(effect.id) || taken.contains(effect.id);
  });
  return further;
}

/// Leaves the best and those that some way to hold out puts level with it, the best four.
void keep_class(std::vector<NameAlone>& names) {
  const double level = names.front().share.share.low;
  std::erase_if(names, [&](const NameAlone& name) { return name.reach < level; });
  if (names.size() > Thresholds::kLargestClass) names.resize(Thresholds::kLargestClass);
}

/// The class as the name that stands for it claims it, the others beside it.
Claim claim_of(const CalibratedRecording& calibrated, const std::vector<NameAlone>& members,
               const NameAlone& leader) {
  NameClass names{.ids = {leader.id}};
  for (const NameAlone& member : members) {
    if (member.id != leader.id) names.ids.push_back(member.id);
  }
  Claim claim = claims_of(calibrated.problem(), {}, {names}, leader.fit).front();
  claim.channels =
      channels_of(calibrated.problem(), leader.fit, leader.fit.candidate.effects.size() - 1);
  claim.share = leader.share.share;
  for (const NameAlone& member : members) claim.member_shares[member.id] = member.share.share;
  return claim;
}

/// The sequence with each of the next class in turn as the name that stands for it.
std::vector<NameSequence> followed(const CalibratedRecording& calibrated,
                                   const std::vector<Effect>& effects, const NameSequence& before,
                                   int threads) {
  const bool is_first = before.claim.claims.empty();
  std::vector<NameAlone> names =
      names_alone(calibrated, further_names(effects, before.claim.claims),
                  is_first ? nullptr : &before.claim.fit, Thresholds::kWorthAnother, threads);
  if (names.empty()) return {};
  keep_class(names);
  const bool is_worth_it = names.front().share.share.low >= Thresholds::kWorthANameAlone;
  if (is_first && (names.size() == 1 || !is_worth_it)) return {};
  std::vector<NameSequence> sequences;
  for (const NameAlone& leader : names) {
    NameSequence longer = before;
    longer.claim.claims.push_back(claim_of(calibrated, names, leader));
    longer.claim.fit = leader.fit;
    longer.claim.steps.push_back(leader.fit);
    if (is_first) {
      for (const NameAlone& name : names) longer.claim.members.push_back(name.fit);
    }
    longer.together = name_share(calibrated, leader.fit, threads);
    if (leader.id != names.front().id) ++longer.not_the_best;
    sequences.push_back(std::move(longer));
  }
  return sequences;
}

}  // namespace

std::optional<PartialClaim> claim_by_shares(const CalibratedRecording& calibrated,
                                            const std::vector<Effect>& effects, int threads) {
  std::optional<NameSequence> best;
  std::vector<NameSequence> beam(1);
  for (std::size_t length = 1; length <= kMostClasses; ++length) {
    std::vector<NameSequence> longer;
    for (const NameSequence& sequence : beam) {
      std::ranges::move(followed(calibrated, effects, sequence, threads),
                        std::back_inserter(longer));
    }
    std::ranges::stable_sort(longer, std::greater{}, &NameSequence::worth);
    for (const NameSequence& sequence : longer) {
      // The first may move a channel the wrong way that the next puts right; all together may not.
      if (sequence.together.worsens()) continue;
      if (!best || sequence.worth() > best->worth()) best = sequence;
    }
    if (longer.size() > kBeam) longer.resize(kBeam);
    beam = std::move(longer);
  }
  if (!best) return std::nullopt;
  return std::move(best->claim);
}

}  // namespace regoplan
