#pragma once

#include <cstdint>
#include <vector>

#include "planner/driving/replay.h"

namespace regoplan {

/// Some of the draws of a seed.
struct DrawRange {
  int first = 0;
  int count = 0;
};

/// The smallest margin in each draw of the soils of the map, one draw for each soil and path, the
/// numbers independent and truncated to their valid ranges; the same draws for every candidate of a
/// seed. Speed, commanded curvature and acceleration are held. Judged are, on every soil that the
/// path crosses, the places where each margin is smallest at the mean soils (`decisive_places`) and
/// those where the drive slipped, drifted and sank most. A margin counts trims only that keep slip,
/// slip angle, sinkage, torque and steering within their limits: where it is kept in a draw, the
/// steady manoeuvre of that place keeps them all. Slope does not depend on the soil. No steady trim
/// at all counts as `MarginSpread::kBroken`.
std::vector<double> smallest_margins(const PlanningProblem& problem, const Replay& verified,
                                     const DrawRange& draws, std::uint64_t seed, int threads);

}  // namespace regoplan
