#include "diagnosis/checks/smallest_detectable.h"

#include <algorithm>
#include <cmath>

namespace regoplan {
namespace {

/// Of a factor's prior standard deviation: what a weaker soil does is far from linear beyond.
constexpr double kFactorTriedAt = -0.5;

/// The soil as calibrated and the effect at its usual size; of factors the first alone, weakened.
Eigen::VectorXd usual_size(const Eigen::VectorXd& soil, const Effect& effect) {
  Eigen::VectorXd x =
      Eigen::VectorXd::Zero(soil.size() + static_cast<Eigen::Index>(effect.coordinates.size()));
  x.head(soil.size()) = soil;
  for (std::size_t i = 0; i < effect.coordinates.size(); ++i) {
    const Coordinate& c = effect.coordinates[i];
    double& at = x[soil.size() + static_cast<Eigen::Index>(i)];
    if (!c.is_positive()) at = 1;
    if (c.is_factor() && i == 0) at = kFactorTriedAt;
  }
  return x;
}

/// \param own coordinates of the effect at its usual size, none where it has no number
/// \param share of that size that is shown
SmallestDetectable smallest_of(const Effect& effect, const Eigen::VectorXd& own, double share) {
  SmallestDetectable smallest{
      .id = effect.id, .parameter = "share", .value = share, .high = 1, .is_usual = share <= 1};
  if (effect.coordinates.empty()) return smallest;
  const Coordinate& c = effect.coordinates.front();
  const double x = own[0];
  smallest.parameter = c.name;
  smallest.value = c.is_factor() ? c.value(share * x) : share * c.value(x);
  smallest.low = c.is_positive() ? c.value(-1) : c.value(-1.5);
  smallest.high = c.is_positive() ? c.value(1) : c.value(1.5);
  smallest.is_usual =
      c.is_factor() ? smallest.value >= smallest.low : smallest.value <= smallest.high;
  return smallest;
}

}  // namespace

std::vector<SmallestDetectable> smallest_detectable(const FitProblem& problem,
                                                    const CandidateFit& base,
                                                    const std::vector<Effect>& effects,
                                                    double critical) {
  std::vector<SmallestDetectable> all;
  const std::vector<std::size_t> noise_only(problem.bed.channels.size(), 0);
  // the misfit is about normal: n + lambda, variance 2n + 4 lambda; power 80 % is .84 deviations
  const auto n = static_cast<double>(problem.bed.size());
  double lambda = 1;
  for (int i = 0; i < 60; ++i) {
    lambda = std::max(n * (critical - 1) + 0.84 * std::sqrt(2 * n + 4 * lambda), 1.0);
  }
  for (const Effect& effect : effects) {
    const bool is_factor = !effect.coordinates.empty() && effect.coordinates.front().is_factor();
    const auto same =
        std::ranges::find(all, effect.id, [](const SmallestDetectable& s) { return s.id; });
    if (same != all.end() && !is_factor) continue;
    Hypothesis candidate{{effect}};
    const Eigen::VectorXd x = usual_size(base.x, effect);
    const auto with = predict(problem.bed, problem.soil, candidate, x);
    if (!with) continue;
    const Posterior posterior =
        posterior_of(problem.bed, problem.discrepancy,
                     {.residual = *with - base.prediction, .jacobian = base.jacobian}, noise_only);
    const Eigen::VectorXd left = *with - base.prediction - base.jacobian * posterior.x;
    const double shown =
        misfit_of(problem.bed, problem.discrepancy, left, noise_only) + posterior.x.squaredNorm();
    if (!(shown > 0)) continue;
    const Eigen::VectorXd own = x.tail(x.size() - base.x.size());
    const SmallestDetectable smallest = smallest_of(effect, own, std::sqrt(lambda / shown));
    if (same == all.end()) {
      all.push_back(smallest);
    } else if (same->parameter == smallest.parameter && smallest.value < same->value) {
      *same = smallest;
    }
  }
  return all;
}

}  // namespace regoplan
