#pragma once

#include <cstddef>
#include <vector>

#include "planner/problem/plan_result.h"

namespace regoplan {

/// Where along a path the stability margin is smallest; a point without one comes before all.
/// \pre points is not empty
std::size_t smallest_margin_index(const std::vector<TrajectoryPoint>& points);

/// The place with the smallest stability margin, and which margin that is: the smallest of the
/// point, one that is missing before all.
LimitingPlace limiting_place(const std::vector<TrajectoryPoint>& points);

/// Mean margin over the tenth of the length where it is smallest; each point stands for the way to
/// the next.
double margin_of_worst_tenth(const std::vector<TrajectoryPoint>& points);

}  // namespace regoplan
