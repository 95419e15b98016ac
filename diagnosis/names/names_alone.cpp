#include "diagnosis/names/names_alone.h"

#include <algorithm>
#include <map>
#include <set>

#include "diagnosis/recording/thresholds.h"
#include "terramech/basics/parallel_for.h"

namespace regoplan {
namespace {

constexpr std::size_t kMostClasses = 3;

std::optional<CandidateFit> fitted_to_wide_noise(const CalibratedRecording& calibrated,
                                                 const Effect& effect, const CandidateFit* beside) {
  constexpr int kSteps = 8;
  const FitProblem problem = calibrated.problem();
  Hypothesis names = beside == nullptr ? Hypothesis{} : beside->candidate;
  names.effects.push_back(effect);
  const CandidateFit& before = beside == nullptr ? calibrated.base() : *beside;
  return fit_to_widened(problem, names, deviations_off(problem.bed, before.prediction),
                        start_of(problem, names, beside), kSteps);
}

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

bool may_stand(const CalibratedRecording& calibrated, const NameAlone& name, double least) {
  return name.share.share.low > least && name.share.gain_in_errors > Thresholds::kClear_errors &&
         objection(calibrated.problem(), name.fit).empty();
}

/// Leaves the best and those that some way to hold out puts level with it, the best four.
void keep_class(std::vector<NameAlone>& names) {
  const double level = names.front().share.share.low;
  std::erase_if(names, [&](const NameAlone& name) { return name.reach < level; });
  if (names.size() > Thresholds::kLargestClass) names.resize(Thresholds::kLargestClass);
}

/// The best, and beside it what does nearly as much.
Claim claim_of(const CalibratedRecording& calibrated, const std::vector<NameAlone>& members) {
  const CandidateFit& fit = members.front().fit;
  NameClass names;
  for (const NameAlone& member : members) names.ids.push_back(member.id);
  Claim claim = claims_of(calibrated.problem(), {}, {names}, fit).front();
  claim.channels = channels_of(calibrated.problem(), fit, fit.candidate.effects.size() - 1);
  claim.share = members.front().share.share;
  for (const NameAlone& member : members) claim.member_shares[member.id] = member.share.share;
  return claim;
}

/// The two forms of each name that explain most where they were fitted, of the twelve names that
/// explain most there. \param forms_of by name: share, and which
std::vector<std::size_t> best_forms(
    std::map<std::string, std::vector<std::pair<double, std::size_t>>>& forms_of) {
  constexpr std::size_t kNames = 12, kForms = 2;
  std::vector<std::pair<double, std::string>> names;
  for (auto& [id, forms] : forms_of) {
    std::ranges::sort(forms, std::greater{});
    names.emplace_back(forms.front().first, id);
  }
  std::ranges::sort(names, std::greater{});
  if (names.size() > kNames) names.resize(kNames);
  std::vector<std::size_t> best;
  for (const auto& [share, id] : names) {
    const auto& forms = forms_of.at(id);
    for (std::size_t k = 0; k < std::min(kForms, forms.size()); ++k) {
      best.push_back(forms[k].second);
    }
  }
  return best;
}

}  // namespace

std::vector<NameAlone> names_alone(const CalibratedRecording& calibrated,
                                   const std::vector<Effect>& effects, const CandidateFit* beside,
                                   double least, int threads) {
  const TestBed& bed = calibrated.bed();
  const double excess =
      variances_off(bed, calibrated.base().prediction) - static_cast<double>(bed.size());
  const double before =
      variances_off(bed, (beside == nullptr ? calibrated.base() : *beside).prediction);
  std::vector<std::optional<CandidateFit>> fits(effects.size());
  parallel_for(fits.size(), threads, [&](std::size_t i) {
    fits[i] = fitted_to_wide_noise(calibrated, effects[i], beside);
  });
  // What explains little where it was fitted explains no more where it was not.
  std::map<std::string, std::vector<std::pair<double, std::size_t>>> forms_of;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    if (!fits[i]) continue;
    const double share = (before - variances_off(bed, fits[i]->prediction)) / excess;
    if (share > least) forms_of[effects[i].id].emplace_back(share, i);
  }
  const std::vector<std::size_t> by_share = best_forms(forms_of);
  std::vector<std::optional<NameAlone>> forms(by_share.size());
  parallel_for(forms.size(), threads, [&](std::size_t k) {
    const std::size_t i = by_share[k];
    const NameShare share = beside == nullptr ? name_share(calibrated, *fits[i], 1)
                                              : added_share(calibrated, *fits[i], *beside, 1);
    forms[k] = NameAlone{effects[i].id, std::move(*fits[i]), share, share.share.high};
  });
  std::map<std::string, NameAlone> best;
  for (std::optional<NameAlone>& form : forms) {
    if (!form || !may_stand(calibrated, *form, least)) continue;
    const auto [known, is_new] = best.try_emplace(form->id, *form);
    if (is_new) continue;
    const double reach = std::max(known->second.reach, form->reach);
    if (form->share.share.low > known->second.share.share.low) known->second = std::move(*form);
    known->second.reach = reach;
  }
  std::vector<NameAlone> names;
  for (auto& [id, name] : best) names.push_back(std::move(name));
  std::ranges::stable_sort(names, std::greater{},
                           [](const NameAlone& name) { return name.share.share.low; });
  return names;
}

std::optional<PartialClaim> claim_by_shares(const CalibratedRecording& calibrated,
                                            const std::vector<Effect>& effects, int threads) {
  PartialClaim result;
  while (result.claims.size() < kMostClasses) {
    const bool is_first = result.claims.empty();
    std::vector<NameAlone> names =
        names_alone(calibrated, further_names(effects, result.claims),
                    is_first ? nullptr : &result.fit, Thresholds::kWorthAnother, threads);
    if (names.empty()) break;
    keep_class(names);
    const bool is_worth_it = names.front().share.share.low >= Thresholds::kWorthANameAlone;
    if (is_first && (names.size() == 1 || !is_worth_it)) return std::nullopt;
    result.claims.push_back(claim_of(calibrated, names));
    if (is_first) {
      for (const NameAlone& name : names) result.members.push_back(name.fit);
    }
    result.fit = std::move(names.front().fit);
    result.steps.push_back(result.fit);
  }
  // The first may move a channel the wrong way that the next puts right; all together may not.
  while (!result.claims.empty() && name_share(calibrated, result.fit, threads).worsened) {
    result.claims.pop_back();
    result.steps.pop_back();
    if (!result.steps.empty()) result.fit = result.steps.back();
  }
  if (result.claims.empty()) return std::nullopt;
  return result;
}

}  // namespace regoplan
