#pragma once

#include <span>
#include <vector>

#include "planner/problem/plan_result.h"

namespace regoplan {

/// For each candidate whether no other beats it: is at least as good in smallest margin, duration
/// and energy, and better in one of them. A number that is not known is worse than any other.
std::vector<bool> pareto_best(std::span<const Candidate> candidates);

}  // namespace regoplan
