#include "diagnosis/names/names_by_chance.h"

#include <algorithm>
#include <cmath>

#include "diagnosis/bed/whitening.h"
#include "diagnosis/recording/thresholds.h"
#include "terramech/basics/parallel_for.h"

namespace regoplan {
namespace {

/// After the soil's columns what the name adds, from nothing to twice its size, then its numbers.
Linearised named_in(const CandidateFit& base, const CappedName& name,
                    const Eigen::VectorXd& world) {
  Linearised model = linear_at(base, world);
  const Eigen::Index soil = base.jacobian.cols();
  const Eigen::Index own = name.fit.jacobian.cols() - soil;
  model.jacobian.resize(world.size(), soil + 1 + own);
  model.jacobian << base.jacobian, name.fit.prediction - base.prediction,
      name.fit.jacobian.rightCols(own);
  return model;
}

bool is_the_wrong_way_round(const CappedName& name, double size) {
  return size < 0 && !is_instrument(name.id);
}

/// Over a misfit without a name.
double best_nats(const CalibratedRecording& calibrated, const CappedContest& contest,
                 const std::vector<CappedName>& names, const Eigen::VectorXd& world) {
  const FitProblem problem = calibrated.problem();
  const CandidateFit& base = calibrated.base();
  const auto evidence = [&](const Linearised& model) {
    return evidence_of(problem.bed, problem.discrepancy, model, problem.soil_free,
                       contest.weights());
  };
  double best = evidence(linear_at(base, world)).log_marginal;
  for (const CappedName& name : names) {
    Linearised model = named_in(base, name, world);
    const Eigen::Index numbers = model.jacobian.cols(), shape = name.fit.shape.cols();
    model.jacobian.conservativeResize(Eigen::NoChange, numbers + shape);
    model.jacobian.rightCols(shape) = name.fit.shape;
    const Evidence named = evidence(model);
    if (is_the_wrong_way_round(name, named.x[base.jacobian.cols()])) continue;
    best = std::max(best, named.log_marginal);
  }
  return best - contest.nameless().log_evidence(world);
}

/// Of the excess misfit; nothing where there is none.
double best_share(const CalibratedRecording& calibrated, const std::vector<CappedName>& names,
                  const Eigen::VectorXd& world) {
  const FitProblem problem = calibrated.problem();
  const CandidateFit& base = calibrated.base();
  const NoiseFactors noise(problem.bed);
  // by the soil and the names alone, as name_share() has it
  const std::vector<std::size_t> noise_only(problem.bed.channels.size(), 0);
  const auto fit = [&](const Linearised& model) {
    return posterior_of(problem.bed, problem.discrepancy, model, noise_only).x;
  };
  const auto misfit = [&](const Linearised& model, const Eigen::VectorXd& x) {
    const Eigen::VectorXd left = model.residual - model.jacobian * x;
    return whitened(problem.bed, noise, left).squaredNorm();
  };
  const Linearised alone = linear_at(base, world);
  const double whole = misfit(alone, fit(alone));
  const auto expected = static_cast<double>(problem.bed.size());
  const double excess = whole - expected;
  if (excess <= Thresholds::kClear_errors * std::sqrt(2 * expected)) return 0;
  double best = 0;
  for (const CappedName& name : names) {
    const Linearised model = named_in(base, name, world);
    const Eigen::VectorXd x = fit(model);
    if (is_the_wrong_way_round(name, x[base.jacobian.cols()])) continue;
    best = std::max(best, (whole - misfit(model, x)) / excess);
  }
  return best;
}

}  // namespace

std::vector<double> nats_by_chance(const CalibratedRecording& calibrated,
                                   const CappedContest& contest,
                                   const std::vector<CappedName>& names, std::uint64_t seed,
                                   int threads) {
  const std::vector<Eigen::VectorXd> worlds = contest.nameless().worlds(seed);
  std::vector<double> nats(worlds.size());
  parallel_for(worlds.size(), threads,
               [&](std::size_t w) { nats[w] = best_nats(calibrated, contest, names, worlds[w]); });
  std::ranges::sort(nats);
  return nats;
}

double reached_by_chance(const std::vector<double>& nats) {
  return nats.empty() ? 0 : nats[nats.size() - 1 - nats.size() / 40];
}

double chance_of_share(const CalibratedRecording& calibrated, const CappedContest& contest,
                       const std::vector<CappedName>& names, std::uint64_t seed, int threads) {
  const std::vector<Eigen::VectorXd> worlds = contest.nameless().worlds(seed);
  std::vector<double> shares(worlds.size());
  parallel_for(worlds.size(), threads,
               [&](std::size_t w) { shares[w] = best_share(calibrated, names, worlds[w]); });
  return chance_of(shares, best_share(calibrated, names, calibrated.residual()));
}

double chance_of(const std::vector<double>& by_chance, double reached) {
  const auto as_much = std::ranges::count_if(by_chance, [&](double one) { return one >= reached; });
  return (1.0 + static_cast<double>(as_much)) / (1.0 + static_cast<double>(by_chance.size()));
}

}  // namespace regoplan
