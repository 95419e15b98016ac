#include "diagnosis/names/names_alone.h"

#include <algorithm>
#include <map>

#include "diagnosis/recording/thresholds.h"
#include "terramech/basics/parallel_for.h"

namespace regoplan {
namespace {

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

bool may_stand(const CalibratedRecording& calibrated, const NameAlone& name, double least) {
  return name.share.share.low > least && name.share.gain_in_errors > Thresholds::kClear_errors &&
         objection(calibrated.problem(), name.fit).empty();
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

}  // namespace regoplan
