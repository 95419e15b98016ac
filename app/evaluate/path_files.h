#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/following/reference_path.h"
#include "planner/problem/planning_problem.h"

namespace regoplan {

/// A path as a file gives it.
struct GivenPath {
  ReferencePath path;
  /// Of a candidate of `plan`: the smallest margin that stands in it.
  std::optional<double> recorded_margin_min;
  std::vector<std::string> notices;
};

/// Reads a CSV table of points `x_m, y_m`, optional `speed_mps`; other columns are ignored with one
/// notice. Negative speeds: the vehicle drives all of it backwards. Without speeds, the path is
/// driven as fast as `speed_max_mps` and the vehicle's acceleration allow, from the problem's start
/// speed to rest. A table with the columns of a candidate of `plan` is that candidate: its own
/// record of curvature, speed and acceleration is what is judged. \throws InputError naming file,
/// line, column and value: NaN, a point farther from the map than its diagonal, a speed above
/// `speed_max_mps`, a single point, no length, more way or time than an evaluation takes on
GivenPath read_path(const std::string& file, const PlanningProblem& problem, double speed_max_mps);

}  // namespace regoplan
