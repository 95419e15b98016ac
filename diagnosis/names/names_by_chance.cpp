#include "diagnosis/names/names_by_chance.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "diagnosis/bed/whitening.h"
#include "diagnosis/recording/thresholds.h"
#include "terramech/basics/parallel_for.h"

namespace regoplan {
namespace {

/// After the soil's columns what the name adds, from nothing to twice its size, then its numbers.
Eigen::MatrixXd columns_with(const CandidateFit& base, const CappedName& name) {
  const Eigen::Index soil = base.jacobian.cols(), own = name.fit.jacobian.cols() - soil;
  Eigen::MatrixXd columns(base.jacobian.rows(), soil + 1 + own);
  columns << base.jacobian, name.fit.prediction - base.prediction, name.fit.jacobian.rightCols(own);
  return columns;
}

bool is_the_wrong_way_round(const CappedName& name, double size) {
  return size < 0 && !is_instrument(name.id);
}

/// Log marginal likelihoods of a name in worlds; of none where its size is the wrong way round.
std::vector<std::optional<double>> named_nats(const FitProblem& problem, const CandidateFit& base,
                                              const CappedName& name, const SettingWeights& weights,
                                              const WhitenedResiduals& worlds) {
  Eigen::MatrixXd columns = columns_with(base, name);
  const Eigen::Index numbers = columns.cols(), shape = name.fit.shape.cols();
  columns.conservativeResize(Eigen::NoChange, numbers + shape);
  columns.rightCols(shape) = name.fit.shape;
  std::vector<std::optional<double>> nats;
  for (const Evidence& one :
       evidence_of(problem.bed, problem.discrepancy, worlds, columns, problem.soil_free, weights)) {
    const bool counts = !is_the_wrong_way_round(name, one.x[base.jacobian.cols()]);
    nats.push_back(counts ? std::optional(one.log_marginal) : std::nullopt);
  }
  return nats;
}

/// Least squares against the noise alone, the numbers standard normal beforehand.
struct NoiseFit {
  Eigen::MatrixXd x;       // a column a residual
  Eigen::VectorXd misfit;  // squared, whitened
};

NoiseFit fit_to_noise(const TestBed& bed, const NoiseFactors& noise, const Eigen::MatrixXd& columns,
                      const Eigen::MatrixXd& residuals) {
  const Eigen::MatrixXd j = whitened(bed, noise, columns);
  Eigen::MatrixXd precision = j.transpose() * j;
  precision.diagonal().array() += 1;
  NoiseFit fit{.x = precision.llt().solve(j.transpose() * residuals)};
  fit.misfit = (residuals - j * fit.x).colwise().squaredNorm().transpose();
  return fit;
}

/// Of the excess misfit of every residual, by the soil and the names alone, as name_share() has it;
/// nothing where there is none.
std::vector<double> best_shares(const CalibratedRecording& calibrated,
                                const std::vector<CappedName>& names,
                                const Eigen::MatrixXd& residuals) {
  const TestBed& bed = calibrated.bed();
  const CandidateFit& base = calibrated.base();
  const NoiseFactors noise(bed);
  const Eigen::MatrixXd white = whitened(bed, noise, beforehand(base, residuals));
  const Eigen::VectorXd whole = fit_to_noise(bed, noise, base.jacobian, white).misfit;
  const auto expected = static_cast<double>(bed.size());
  const double least = Thresholds::kClear_errors * std::sqrt(2 * expected);
  std::vector<double> best(static_cast<std::size_t>(residuals.cols()));
  for (const CappedName& name : names) {
    const NoiseFit named = fit_to_noise(bed, noise, columns_with(base, name), white);
    for (Eigen::Index w = 0; w < residuals.cols(); ++w) {
      const double excess = whole[w] - expected;
      if (excess <= least || is_the_wrong_way_round(name, named.x(base.jacobian.cols(), w)))
        continue;
      double& share = best[static_cast<std::size_t>(w)];
      share = std::max(share, (whole[w] - named.misfit[w]) / excess);
    }
  }
  return best;
}

}  // namespace

std::vector<double> nats_by_chance(const CalibratedRecording& calibrated,
                                   const CappedContest& contest,
                                   const std::vector<CappedName>& names, std::uint64_t seed,
                                   int threads) {
  const FitProblem problem = calibrated.problem();
  const CandidateFit& base = calibrated.base();
  const WhitenedResiduals worlds(problem.bed, problem.discrepancy,
                                 beforehand(base, contest.nameless().worlds(seed)),
                                 SettingWeights::of_unexplained());
  std::vector<std::vector<std::optional<double>>> named(names.size());
  parallel_for(names.size(), threads, [&](std::size_t i) {
    named[i] = named_nats(problem, base, names[i], contest.weights(), worlds);
  });
  const std::vector<Evidence> alone =
      evidence_of(problem.bed, problem.discrepancy, worlds, base.jacobian, problem.soil_free,
                  contest.weights());
  std::vector<double> nats = contest.nameless().log_evidence(worlds);
  for (std::size_t w = 0; w < nats.size(); ++w) {
    double best = alone[w].log_marginal;
    for (const auto& name : named) best = std::max(best, name[w].value_or(best));
    nats[w] = best - nats[w];
  }
  std::ranges::sort(nats);
  return nats;
}

double reached_by_chance(const std::vector<double>& nats) {
  return nats.empty() ? 0 : nats[nats.size() - 1 - nats.size() / 40];
}

double chance_of_share(const CalibratedRecording& calibrated, const CappedContest& contest,
                       const std::vector<CappedName>& names, std::uint64_t seed) {
  return chance_of(best_shares(calibrated, names, contest.nameless().worlds(seed)),
                   best_shares(calibrated, names, calibrated.residual()).front());
}

double chance_of(const std::vector<double>& by_chance, double reached) {
  const auto as_much = std::ranges::count_if(by_chance, [&](double one) { return one >= reached; });
  return (1.0 + static_cast<double>(as_much)) / (1.0 + static_cast<double>(by_chance.size()));
}

}  // namespace regoplan
