#include "diagnosis/names/capped_contest.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "diagnosis/bed/whitening.h"
#include "diagnosis/names/name_share.h"
#include "diagnosis/recording/thresholds.h"
#include "terramech/basics/parallel_for.h"

namespace regoplan {
namespace {

/// Where evidence for a smooth misfit finds no longer scale than these, it may have one.
DiscrepancyScales beyond_the_longest() {
  const DiscrepancyScales& longest = discrepancy_scales().back();
  return {.slip = 2 * longest.slip,
          .slip_angle_rad = 2 * longest.slip_angle_rad,
          .log_load = 2 * longest.log_load};
}

/// Factors of the covariances, noise and misfit, of worlds whose misfit is as large as this setting
/// says and as smooth or smoother.
std::vector<Eigen::LLT<Eigen::MatrixXd>> nameless_covariances(const TestBed& bed,
                                                              const ChannelData& data,
                                                              std::size_t setting) {
  const DiscrepancySetting& found = discrepancy_settings()[setting];
  if (found.amplitude == 0) return {Eigen::LLT<Eigen::MatrixXd>(data.noise)};
  const double deviation = found.amplitude * data.scale;
  const ConditionsAt at = conditions_of(bed, data);
  std::vector<DiscrepancyScales> all = discrepancy_scales();
  all.push_back(beyond_the_longest());
  std::vector<Eigen::LLT<Eigen::MatrixXd>> factors;
  for (std::size_t k = found.scales; k < all.size(); ++k) {
    factors.emplace_back(data.noise +
                         deviation * deviation *
                             discrepancy_kernels(all[k], data.channel, at, at, found.sides));
  }
  return factors;
}

}  // namespace

CappedContest::CappedContest(const CalibratedRecording& calibrated) : calibrated_(calibrated) {
  const FitProblem problem = calibrated.problem();
  const Cap cap = cap_for(problem.bed.measured() - calibrated.base().prediction);
  alone_settings_ = cap.settings;
  weights_ = cap.weights;
  const auto alone = fit_candidate(
      problem, {}, weights_, Eigen::VectorXd::Zero(static_cast<Eigen::Index>(problem.soil.size())));
  alone_nats_ = alone->evidence.log_marginal;
}

CappedContest::Cap CappedContest::cap_for(const Eigen::VectorXd& residual) const {
  const FitProblem problem = calibrated_.problem();
  const Evidence free =
      evidence_of(problem.bed, problem.discrepancy,
                  {.residual = residual + calibrated_.base().jacobian * calibrated_.base().x,
                   .jacobian = calibrated_.base().jacobian},
                  Eigen::MatrixXd(problem.bed.size(), 0), SettingWeights::of_unexplained());
  std::vector<double> most;
  for (const std::size_t k : free.settings) {
    most.push_back(Thresholds::kCapShare * discrepancy_settings()[k].amplitude);
  }
  return {free.settings, SettingWeights::up_to(std::move(most))};
}

std::vector<CappedName> CappedContest::score(const std::vector<Effect>& effects,
                                             const CandidateFit* beside, int threads) const {
  const FitProblem problem = calibrated_.problem();
  std::vector<std::optional<CandidateFit>> fits(effects.size());
  parallel_for(effects.size(), threads, [&](std::size_t i) {
    Hypothesis candidate = beside == nullptr ? Hypothesis{} : beside->candidate;
    candidate.effects.push_back(effects[i]);
    fits[i] = fit_candidate(problem, candidate, weights_, start_of(problem, candidate, beside));
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
  std::vector<double> shares;
  for (const CandidateFit* fit : near) {
    const NameShare share = beside == nullptr ? name_share(calibrated_, *fit, 1)
                                              : added_share(calibrated_, *fit, *beside, 1);
    shares.push_back(share.share.low);
  }
  return *near[static_cast<std::size_t>(std::ranges::max_element(shares) - shares.begin())];
}

ByChance CappedContest::best_in_world(const std::vector<CappedName>& names,
                                      const Eigen::VectorXd& world) const {
  const FitProblem problem = calibrated_.problem();
  const CandidateFit& base = calibrated_.base();
  const Eigen::VectorXd at_base = world + base.jacobian * base.x;
  const double alone =
      evidence_of(problem.bed, problem.discrepancy,
                  {.residual = at_base, .jacobian = base.jacobian}, problem.soil_free, weights_)
          .log_marginal;
  // what is left without a remainder, as name_share() has it
  const NoiseFactors noise(problem.bed);
  const std::vector<std::size_t> noise_only(problem.bed.channels.size(), 0);
  const auto misfit_by = [&](const Linearised& model) {
    const Posterior fit = posterior_of(problem.bed, problem.discrepancy, model, noise_only);
    const Eigen::VectorXd left = model.residual - model.jacobian * fit.x;
    return whitened(problem.bed, noise, left).squaredNorm();
  };
  const double misfit = misfit_by({.residual = at_base, .jacobian = base.jacobian});
  const auto expected = static_cast<double>(problem.bed.size());
  const double excess = misfit - expected;
  const bool is_clear = excess > Thresholds::kClear_errors * std::sqrt(2 * expected);
  ByChance best;
  for (const CappedName& name : names) {
    // what it adds, from nothing to twice its size, then the shapes in which it may err
    const Eigen::VectorXd part = name.fit.prediction - base.prediction;
    const Eigen::Index soil = base.jacobian.cols(), shape = name.fit.shape.cols();
    const Eigen::Index own = name.fit.jacobian.cols() - soil;
    Linearised model{.residual = at_base};
    model.jacobian.resize(problem.bed.size(), soil + 1 + own + shape);
    model.jacobian << base.jacobian, part, name.fit.jacobian.rightCols(own), name.fit.shape;
    const Evidence evidence =
        evidence_of(problem.bed, problem.discrepancy, model, problem.soil_free, weights_);
    if (evidence.x[soil] < 0 && !is_instrument(name.id)) continue;  // the wrong way round
    if (evidence.log_marginal - alone <= best.gain_nats) continue;
    const double left =
        misfit_by({.residual = at_base, .jacobian = model.jacobian.leftCols(soil + 1 + own)});
    best = {evidence.log_marginal - alone, is_clear ? (misfit - left) / excess : 0};
  }
  return best;
}

std::vector<ByChance> CappedContest::by_chance(const std::vector<CappedName>& names, int worlds,
                                               std::uint64_t seed, int threads) const {
  const FitProblem problem = calibrated_.problem();
  const TestBed& bed = problem.bed;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<std::vector<Eigen::LLT<Eigen::MatrixXd>>> covariances;
  for (std::size_t c = 0; c < bed.channels.size(); ++c) {
    covariances.push_back(nameless_covariances(bed, bed.channels[c], alone_settings_[c]));
  }
  std::vector<Eigen::VectorXd> drawn;
  for (std::size_t w = 0; w < static_cast<std::size_t>(worlds); ++w) {
    Eigen::VectorXd world(bed.size());
    for (std::size_t c = 0; c < bed.channels.size(); ++c) {
      const Eigen::Index n = bed.channels[c].mean.size();
      Eigen::VectorXd z(n);
      for (double& value : z) value = normal(random);
      world.segment(bed.offset(c), n) = covariances[c][w % covariances[c].size()].matrixL() * z;
    }
    drawn.push_back(std::move(world));
  }
  std::vector<ByChance> reached(drawn.size());
  parallel_for(drawn.size(), threads,
               [&](std::size_t w) { reached[w] = best_in_world(names, drawn[w]); });
  std::ranges::sort(reached, {}, &ByChance::gain_nats);
  return reached;
}

}  // namespace regoplan
