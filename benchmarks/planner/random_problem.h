#pragma once

#include <cstdint>
#include <string>

#include "planner/problem/planning_problem.h"

namespace regoplan {

/// A small map drawn at random, 40 m square: bumps, a bank across that may be too steep, a wall of
/// rocks with or without a gap, rocks strewn about. An LRV is to cross it on firm lunar soil. About
/// half of them cannot be crossed. Start and goal may be asked for (`validate`).
PlanningProblem random_problem(std::uint64_t seed);

/// Whether one brief run of a planner finds a path that passes verification.
bool verified_path_found(const PlanningProblem& problem, const std::string& planner,
                         std::int64_t iterations);

}  // namespace regoplan
