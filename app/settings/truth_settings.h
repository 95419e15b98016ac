#pragma once

#include <string>

#include "driving/drive_truth.h"
#include "planner/problem/planning_problem.h"

namespace regoplan {

/// Reads a truth file, docs/drive.md: how the world driven in differs from the problem's.
/// \throws SettingsError
DriveTruth read_truth(const std::string& file, const PlanningProblem& problem);

/// As `read_truth`, for text that stands in `file`.
DriveTruth parse_truth(const std::string& text, const std::string& file,
                       const PlanningProblem& problem);

}  // namespace regoplan
