#pragma once

#include <cstdint>
#include <vector>

#include "planner/draw_statistics.h"

namespace regoplan {

struct PlanningProblem;
struct Replay;

/// How a candidate's smallest stability margin spreads over what is known of the soils.
struct MarginSpread {
  /// What a place without any steady trim counts as: limits are broken there.
  static constexpr double kBroken = -1;

  int draws = 0;
  double p05 = 0;                    ///< 5 % quantile of the smallest margin
  double p05_low = 0, p05_high = 0;  ///< its 95 % interval, of sampling alone
  Probability feasible;              ///< that the smallest margin is allowed
};

/// Some of the draws of a seed.
struct DrawRange {
  int first = 0;
  int count = 0;
};

/// The smallest margin in each draw of the soils of the map, one draw for each soil and path, the
/// numbers independent and truncated to their valid ranges; the same draws for every candidate of a
/// seed. Speed, commanded curvature and acceleration are held; the margins are judged at the places
/// where each is smallest at the mean soils (`decisive_places`), on every soil that the path
/// crosses. No steady trim at
/// all counts as `MarginSpread::kBroken`.
std::vector<double> smallest_margins(const PlanningProblem& problem, const Replay& verified,
                                     const DrawRange& draws, std::uint64_t seed, int threads);

/// \param smallest margin of each draw, at least one \param margin_min the least that is allowed
MarginSpread margin_spread(const std::vector<double>& smallest, double margin_min);

}  // namespace regoplan
