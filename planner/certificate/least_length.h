#pragma once

#include <cstdint>
#include <vector>

#include "planner/certificate/open_boxes.h"
#include "planner/problem/planning_problem.h"

namespace regoplan {

/// A length that no path of the vehicle's origin from a place to the goal can be shorter than: the
/// straight one, or the way round what is closed, whichever is longer.
///
/// The way round is counted in moves between neighbouring places, diagonals too, of which
/// `OpenBoxes` leaves any heading open. The shortest curve that keeps off the closed ones is made
/// of straight pieces between their corners. One that spans a columns and b rows takes at most
/// max(a, b) moves, the one round the corner included, and is no shorter than as many cells; the
/// curve's two ends may add a move each. So moves - 2 cells bound the length (`LeastLength` tests).
class LeastLength {
 public:
  /// Looks at every place that the goal can be reached from: about a microsecond each.
  explicit LeastLength(const PlanningProblem& problem);

  /// Metres; infinite where no way leads to the goal.
  double to_goal_m(double x_m, double y_m) const;

 private:
  Goal goal_;
  PlaceGrid grid_;
  std::vector<std::int32_t> moves_;  ///< from each place to the goal; negative where none lead
};

}  // namespace regoplan
