#include "diagnosis/checks/bed_memory.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "diagnosis/bed/condition_axes.h"
#include "diagnosis/fit/unnamed_correction.h"

namespace regoplan {
namespace {

/// What another soil would change under all conditions.
std::optional<Eigen::VectorXd> change_by_soil(const FitProblem& problem, const CandidateFit& fit,
                                              double stiffness, double limit) {
  Hypothesis other = fit.candidate;
  other.effects.push_back(
      {.id = "soil_zone",
       .form = "factors",
       .fixed = {{"from_m", -1e9}, {"to_m", 1e9}, {"stiffness", stiffness}, {"limit", limit}}});
  const auto changed = predict(problem.bed, problem.soil, other, fit.x);
  if (!changed) return std::nullopt;
  return *changed - fit.prediction;
}

/// Values times a power of the slip of the run before.
Eigen::VectorXd remembered(const TestBed& bed, Eigen::VectorXd values, double power) {
  for (std::size_t c = 0; c < bed.channels.size(); ++c) {
    const ChannelData& data = bed.channels[c];
    for (std::size_t i = 0; i < data.conditions.size(); ++i) {
      values[bed.offset(c) + static_cast<Eigen::Index>(i)] *=
          std::pow(std::abs(bed.conditions[data.conditions[i]].after_slip_ratio), power);
    }
  }
  return values;
}

std::vector<Eigen::VectorXd> ways_to_remember(const FitProblem& problem, const CandidateFit& fit) {
  const TestBed& bed = problem.bed;
  std::vector<Eigen::VectorXd> ways;
  for (const auto& [stiffness, limit] : {std::pair{0.8, 1.0}, {1.0, 0.9}, {0.9, 0.9}}) {
    const auto change = change_by_soil(problem, fit, stiffness, limit);
    if (!change) continue;
    for (const double power : {1.0, 2.0}) ways.push_back(remembered(bed, *change, power));
  }
  for (std::size_t c = 0; c < bed.channels.size(); ++c) {
    Eigen::VectorXd one = Eigen::VectorXd::Zero(bed.size());
    one.segment(bed.offset(c), bed.channels[c].mean.size()).setConstant(bed.channels[c].scale);
    ways.push_back(remembered(bed, std::move(one), 1));
  }
  return ways;
}

}  // namespace

double deviations_of_memory(const FitProblem& problem, const CandidateFit& fit) {
  if (!memory_axis(problem.bed)) return 0;
  constexpr double kFree = 100;  // deviations of the noise: how far a way may go beforehand
  const std::vector<std::size_t> surface = remainder_settings(problem, fit);
  const Eigen::Index last = fit.jacobian.cols();
  Linearised model{.residual = problem.bed.measured() - fit.prediction + fit.jacobian * fit.x};
  model.jacobian.resize(problem.bed.size(), last + 1);
  model.jacobian.leftCols(last) = fit.jacobian;
  double most = 0;
  for (const Eigen::VectorXd& way : ways_to_remember(problem, fit)) {
    const double size = std::sqrt(misfit_of(problem.bed, problem.discrepancy, way, surface));
    if (!(size > 0)) continue;
    model.jacobian.col(last) = kFree / size * way;
    const Posterior posterior = posterior_of(problem.bed, problem.discrepancy, model, surface);
    const Eigen::VectorXd spread =
        posterior.precision.llt().solve(Eigen::VectorXd::Unit(last + 1, last));
    most = std::max(most, std::abs(posterior.x[last]) / std::sqrt(spread[last]));
  }
  return most;
}

}  // namespace regoplan
