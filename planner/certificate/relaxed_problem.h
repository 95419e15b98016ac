#pragma once

#include <optional>
#include <string>

#include "planner/problem/planning_problem.h"

namespace regoplan {

/// Why no path can exist; nothing where that cannot be shown.
///
/// The relaxed problem: the vehicle may move freely between neighbouring boxes of place and heading
/// (and turn on the spot), at any speed, margins aside. A box is closed only where every pose in it
/// is forbidden:
/// - off the map;
/// - a wheel on unknown or forbidden ground, wherever in the box the vehicle stands;
/// - a plane through the wheels' contacts steeper than the limit: the plane that fits the ground
///   around the box best, less what the ground's deviations from it can turn the contacts' plane;
/// - a rock, too high to pass below the body, that reaches into the part of the body's outline that
///   every pose in the box covers.
/// Without a way through open boxes there is no path, whatever the soils, wheels and controls: what
/// holds for all poses of a box holds for the verdict's. The converse does not hold.
std::optional<std::string> certificate_of_infeasibility(const PlanningProblem& problem);

}  // namespace regoplan
