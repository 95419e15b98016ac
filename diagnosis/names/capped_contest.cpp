#include "diagnosis/names/capped_contest.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "diagnosis/names/name_share.h"
#include "diagnosis/recording/thresholds.h"
#include "terramech/basics/parallel_for.h"

namespace regoplan {
CappedContest::Cap CappedContest::cap_for(const CalibratedRecording& calibrated) {
  const FitProblem problem = calibrated.problem();
  const CandidateFit& base = calibrated.base();
  const Linearised alone{.residual = beforehand(base, calibrated.residual()),
                         .jacobian = base.jacobian};
  const Evidence free =
      evidence_of(problem.bed, problem.discrepancy, alone, Eigen::MatrixXd(problem.bed.size(), 0),
                  SettingWeights::of_unexplained());
  std::vector<double> most;
  for (const std::size_t k : free.settings) {
    most.push_back(Thresholds::kCapShare * discrepancy_settings()[k].amplitude);
  }
  return {free.settings, SettingWeights::up_to(std::move(most))};
}

CappedContest::CappedContest(const CalibratedRecording& calibrated)
    : calibrated_(calibrated),
      cap_(cap_for(calibrated)),
      nameless_(calibrated, cap_.settings, cap_.weights) {
  const FitProblem problem = calibrated.problem();
  const auto alone =
      fit_candidate(problem, {}, cap_.weights,
                    Eigen::VectorXd::Zero(static_cast<Eigen::Index>(problem.soil.size())));
  alone_nats_ = alone->evidence.log_marginal;
  const WhitenedResiduals recorded(problem.bed, problem.discrepancy,
                                   beforehand(calibrated.base(), calibrated.residual()),
                                   SettingWeights::of_unexplained());
  nameless_nats_ = nameless_.log_evidence(recorded).front();
}

std::vector<CappedName> CappedContest::score(const std::vector<Effect>& effects,
                                             const CandidateFit* beside, int threads) const {
  const FitProblem problem = calibrated_.problem();
  std::vector<std::optional<CandidateFit>> fits(effects.size());
  parallel_for(effects.size(), threads, [&](std::size_t i) {
    Hypothesis candidate = beside == nullptr ? Hypothesis{} : beside->candidate;
    candidate.effects.push_back(effects[i]);
    fits[i] = fit_candidate(problem, candidate, cap_.weights, start_of(problem, candidate, beside));
  });
  std::map<std::string, std::vector<CandidateFit>> forms;
  std::map<std::string, std::size_t> tried;
  for (std::size_t i = 0; i < effects.size(); ++i) {
    ++tried[effects[i].id];
    if (fits[i]) forms[effects[i].id].push_back(std::move(*fits[i]));
  }
  std::vector<CappedName> names;
  for (const auto& [id, of_id] : forms) {
    MarginalFit marginal = marginal_of(of_id, tried[id]);
    names.push_back({.id = id,
                     .gain_nats = marginal.log_marginal - alone_nats_,
                     .over_unexplained_nats = marginal.log_marginal - nameless_nats_,
                     .fit = std::move(marginal.likeliest)});
  }
  std::ranges::stable_sort(names, std::greater{}, &CappedName::gain_nats);
  std::vector<CappedName*> leading;
  for (CappedName& name : names) {
    if (name.gain_nats > names.front().gain_nats - Thresholds::kLeading_nats)
      leading.push_back(&name);
  }
  parallel_for(leading.size(), threads, [&](std::size_t i) {
    leading[i]->fit = best_predicting(forms.at(leading[i]->id), beside);
  });
  return names;
}

CandidateFit CappedContest::best_predicting(const std::vector<CandidateFit>& forms,
                                            const CandidateFit* beside) const {
  double top = -INFINITY;
  for (const CandidateFit& fit : forms) top = std::max(top, fit.evidence.log_marginal);
  std::vector<const CandidateFit*> near;
  for (const CandidateFit& fit : forms) {
    if (fit.evidence.log_marginal >= top - Thresholds::kNearForm_nats) near.push_back(&fit);
  }
  if (near.size() == 1) return *near.front();
  std::vector<std::pair<bool, double>> proofs;  // whether no channel gets worse, and the share
  for (const CandidateFit* fit : near) {
    const NameShare share = beside == nullptr ? name_share(calibrated_, *fit, 1)
                                              : added_share(calibrated_, *fit, *beside, 1);
    proofs.emplace_back(!share.worsens(), share.share.low);
  }
  return *near[static_cast<std::size_t>(std::ranges::max_element(proofs) - proofs.begin())];
}

}  // namespace regoplan
