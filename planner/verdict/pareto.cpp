#include "planner/verdict/pareto.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

namespace regoplan {
namespace {

/// Smaller is better in each.
using Costs = std::array<double, 3>;

Costs costs_of(const Candidate& candidate) {
  Costs costs{-candidate.margin_min, candidate.duration_s, candidate.energy_j};
  for (double& cost : costs) {
    if (std::isnan(cost)) cost = std::numeric_limits<double>::infinity();
  }
  return costs;
}

bool beats(const Costs& a, const Costs& b) {
  return a != b && std::ranges::equal(a, b, std::less_equal());
}

}  // namespace

std::vector<bool> pareto_best(std::span<const Candidate> candidates) {
  std::vector<Costs> costs;
  for (const Candidate& candidate : candidates) costs.push_back(costs_of(candidate));
  std::vector<bool> best;
  for (const Costs& own : costs) {
    best.push_back(
        std::ranges::none_of(costs, [&](const Costs& other) { return beats(other, own); }));
  }
  return best;
}

}  // namespace regoplan
