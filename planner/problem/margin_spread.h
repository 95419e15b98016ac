#pragma once

#include <vector>

#include "planner/runtime/draw_statistics.h"

namespace regoplan {

/// How a candidate's smallest stability margin spreads over what is known of the soils.
struct MarginSpread {
  /// What a place without any steady trim counts as: limits are broken there.
  static constexpr double kBroken = -1;

  int draws = 0;                     ///< 0 where every soil number is known
  double p05 = 0;                    ///< 5 % quantile of the smallest margin
  double p05_low = 0, p05_high = 0;  ///< its 95 % interval, of sampling alone
  double p50 = 0;                    ///< the median, which six draws bound on both sides
  double p50_low = 0, p50_high = 0;  ///< likewise
  /// The share of the draws in which every judged place has a steady manoeuvre within all limits,
  /// with the least margin (`smallest_margins`): what starting and ending it takes is not in it.
  Probability feasible;
};

/// \param smallest margin of each draw, at least one \param margin_min the least that is allowed
MarginSpread margin_spread(const std::vector<double>& smallest, double margin_min);

/// Where every soil number is known there is nothing to draw: the margin itself, without any
/// sampling error.
MarginSpread known_margin(double smallest, double margin_min);

}  // namespace regoplan
