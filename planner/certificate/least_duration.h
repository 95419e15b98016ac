#pragma once

#include "planner/problem/planning_problem.h"

namespace regoplan {

/// A time that no path of a problem can be faster than, seconds: the least length
/// (`LeastLength`), driven at the highest speed that the limits allow at each moment. That is
/// the speed limit (held within .1 %), and, because rims speed up and slow down at
/// `acceleration_max_mps2` and no wheel may skid beyond `slip_max` (eq. 1, braking: the vehicle is
/// at most 1/(1 - slip_max) times as fast as its rims), what can be reached from the start's speed
/// and be brought down to what the goal allows. Infinite where no way leads to the
/// goal.
double least_duration_s(const PlanningProblem& problem);

/// The same of a length: from a speed, to at most another at the end, metres and seconds.
struct FastestDrive {
  double speed_max_mps = 0;
  double acceleration_mps2 = 0;
  double start_mps = 0;
  double end_mps = 0;

  double duration_s(double length_m) const;
};

}  // namespace regoplan
