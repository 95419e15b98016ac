#pragma once

#include <cstdint>
#include <vector>

#include "planner/replay.h"

namespace regoplan {

/// How a candidate's smallest stability margin spreads over what is known of the soils.
struct MarginSpread {
  double p05 = 0;                   ///< 5 % quantile of the smallest margin
  double probability_feasible = 0;  ///< share of draws whose smallest margin is allowed
};

/// Draws the soils of the map, one draw for each soil and path, the numbers independent and
/// truncated to their valid ranges; the same draws for every candidate of a seed. Speed, commanded
/// curvature and acceleration are held; the margins are judged at the places where they are
/// smallest at the mean soils and at a few spread along the path. No steady trim at all counts as a
/// margin of -1.
/// \param draws at least 1
MarginSpread margin_spread(const PlanningProblem& problem, const Replay& verified, int draws,
                           std::uint64_t seed, int threads);

}  // namespace regoplan
