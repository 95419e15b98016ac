#include "diagnosis/candidate_fit.h"

#include <algorithm>
#include <cmath>

namespace regoplan {
namespace {

constexpr double kFarthest = 6;  // prior standard deviations

bool is_slow(const Candidate& candidate) {
  return std::ranges::any_of(candidate.effects, &Effect::slow);
}

Linearised linearised(const TestBed& bed, const CandidateFit& fit) {
  return {.residual = bed.measured() - fit.prediction + fit.jacobian * fit.x,
          .jacobian = fit.jacobian};
}

/// One damped step; false where nothing better was found.
bool step(const FitProblem& problem, const std::vector<std::size_t>& settings, CandidateFit& fit) {
  const TestBed& bed = problem.bed;
  const Eigen::VectorXd measured = bed.measured();
  const auto cost = [&](const Eigen::VectorXd& prediction, const Eigen::VectorXd& x) {
    return misfit_of(bed, problem.discrepancy, measured - prediction, settings) + x.squaredNorm();
  };
  const Posterior goal = posterior_of(bed, problem.discrepancy, linearised(bed, fit), settings);
  const double before = cost(fit.prediction, fit.x);
  for (double share = 1; share > 0.02; share *= 0.4) {
    const Eigen::VectorXd x =
        (fit.x + share * (goal.x - fit.x)).cwiseMin(kFarthest).cwiseMax(-kFarthest);
    const auto prediction = predict(bed, problem.soil, fit.candidate, x);
    if (!prediction) continue;
    const double after = cost(*prediction, x);
    if (!(after < before)) continue;
    fit.x = x;
    fit.prediction = *prediction;
    return before - after > 1e-3 * (1 + 1e-3 * before);
  }
  return false;
}

bool renew_jacobian(const FitProblem& problem, CandidateFit& fit, bool soil_too) {
  const Eigen::Index from = soil_too ? 0 : static_cast<Eigen::Index>(problem.soil.size());
  const auto columns =
      jacobian_of(problem.bed, problem.soil, fit.candidate, fit.x, fit.prediction, from);
  if (!columns) return false;
  fit.jacobian.rightCols(columns->cols()) = *columns;
  return true;
}

/// \return whether the start could be evaluated
bool begin(const FitProblem& problem, CandidateFit& fit) {
  const auto prediction = predict(problem.bed, problem.soil, fit.candidate, fit.x);
  if (!prediction) return false;
  fit.prediction = *prediction;
  fit.jacobian.resize(problem.bed.size(), fit.x.size());
  return renew_jacobian(problem, fit, true);
}

void descend(const FitProblem& problem, const std::vector<std::size_t>& settings, int steps,
             CandidateFit& fit) {
  const bool slow = is_slow(fit.candidate);
  for (int i = 0; i < steps; ++i) {
    const bool better = step(problem, settings, fit);
    if (!renew_jacobian(problem, fit, !slow || i == steps - 1 || !better) || !better) break;
  }
}

}  // namespace

std::optional<Eigen::MatrixXd> jacobian_of(const TestBed& bed,
                                           const std::vector<SoilCoordinate>& soil,
                                           const Candidate& candidate, const Eigen::VectorXd& x,
                                           const Eigen::VectorXd& prediction, Eigen::Index from,
                                           bool central, double step) {
  Eigen::MatrixXd columns(prediction.size(), x.size() - from);
  for (Eigen::Index i = from; i < x.size(); ++i) {
    const auto moved = [&](double by) {
      Eigen::VectorXd at = x;
      at[i] += by;
      return predict(bed, soil, candidate, at);
    };
    const auto up = moved(step);
    const auto down = central || !up ? moved(-step) : std::nullopt;
    if (up && down) {
      columns.col(i - from) = (*up - *down) / (2 * step);
    } else if (up) {
      columns.col(i - from) = (*up - prediction) / step;
    } else if (down) {
      columns.col(i - from) = (prediction - *down) / step;
    } else {
      return std::nullopt;
    }
  }
  return columns;
}

std::optional<CandidateFit> fit_under(const FitProblem& problem, const Candidate& candidate,
                                      const std::vector<std::size_t>& settings,
                                      const Eigen::VectorXd& start, int steps) {
  CandidateFit fit{.candidate = candidate, .x = start};
  if (!begin(problem, fit)) return std::nullopt;
  descend(problem, settings, steps, fit);
  fit.evidence.settings = settings;
  return fit;
}

std::optional<CandidateFit> fit_candidate(const FitProblem& problem, const Candidate& candidate,
                                          const SettingWeights& weights,
                                          const Eigen::VectorXd& start) {
  CandidateFit fit{.candidate = candidate, .x = start};
  if (!begin(problem, fit)) return std::nullopt;
  // begin under a discrepancy of twice a run's noise over middling scales
  std::size_t middling = 0;
  for (std::size_t k = 0; k < discrepancy_settings().size(); ++k) {
    const DiscrepancySetting& setting = discrepancy_settings()[k];
    if (setting.amplitude == 2 && setting.scales == 1) middling = k;
  }
  std::vector<std::size_t> settings(problem.bed.channels.size(), middling);
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    descend(problem, settings, round == 0 ? 5 : 3, fit);
    fit.evidence = evidence_of(problem.bed, problem.discrepancy, linearised(problem.bed, fit),
                               problem.soil_free, weights);
    if (fit.evidence.settings == settings) break;
    settings = fit.evidence.settings;
  }
  return fit;
}

}  // namespace regoplan
