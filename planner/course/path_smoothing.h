#pragma once

#include <vector>

#include "planner/course/path_curve.h"
#include "planner/problem/planning_problem.h"

namespace regoplan {

/// The knots of a path moved to where it is shorter and straighter (least squares by Ceres), no
/// sharper than a curvature, clear of rocks and of ground that is too steep. Only a proposal: what
/// it leads to must be driven to be judged. The first two knots stay, so do the last two where the
/// goal asks for a heading; else the last stays within the goal. Deterministic.
/// \param knots about evenly spaced, at least four
std::vector<PathPoint> smoothed(const PlanningProblem& problem, const std::vector<PathPoint>& knots,
                                double curvature_max_1pm);

}  // namespace regoplan
