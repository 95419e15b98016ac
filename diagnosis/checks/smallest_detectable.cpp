#include "diagnosis/checks/smallest_detectable.h"

#include <algorithm>
#include <cmath>

namespace regoplan {

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
    if (std::ranges::any_of(all, [&](const auto& s) { return s.id == effect.id; })) continue;
    Hypothesis candidate{{effect}};
    Eigen::VectorXd x(base.x.size() + static_cast<Eigen::Index>(effect.coordinates.size()));
    x.head(base.x.size()) = base.x;
    for (std::size_t i = 0; i < effect.coordinates.size(); ++i) {
      x[base.x.size() + static_cast<Eigen::Index>(i)] = effect.coordinates[i].is_positive() ? 0 : 1;
    }
    const auto with = predict(problem.bed, problem.soil, candidate, x);
    if (!with) continue;
    const Posterior posterior =
        posterior_of(problem.bed, problem.discrepancy,
                     {.residual = *with - base.prediction, .jacobian = base.jacobian}, noise_only);
    const Eigen::VectorXd left = *with - base.prediction - base.jacobian * posterior.x;
    const double shown =
        misfit_of(problem.bed, problem.discrepancy, left, noise_only) + posterior.x.squaredNorm();
    if (!(shown > 0)) continue;
    const double factor = std::sqrt(lambda / shown);
    SmallestDetectable smallest{.id = effect.id, .parameter = "share", .value = factor, .high = 1};
    if (!effect.coordinates.empty()) {
      const Coordinate& c = effect.coordinates.front();
      smallest.parameter = c.name;
      smallest.value = factor * c.value(x[base.x.size()]);
      smallest.low = c.is_positive() ? c.value(-1) : c.value(-1.5);
      smallest.high = c.is_positive() ? c.value(1) : c.value(1.5);
    }
    all.push_back(smallest);
  }
  return all;
}

}  // namespace regoplan
