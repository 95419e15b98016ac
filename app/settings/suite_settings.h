#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "benchmarking/suite.h"
#include "planner/problem/planning_problem.h"

namespace regoplan {

/// Whether a name may stand in OMPL's logs, file names and shells, and what that is in words.
bool is_label(std::string_view text);
inline constexpr const char* kLabelRule = "letters, digits, _, - and .";

/// Reads SUITE.yaml:
///
///     name: six_by_five
///     scenarios: [scenarios/crater_rim.yaml, {name: rim, file: FILE.yaml}]
///     planners: [RRT, {name: RRT_greedy, planner: RRT, parameters: {goal_bias: 0.3}}]
///     seeds: 20                       # 1 to 20, or a list
///     time_s: 2                       # of each search
///     iterations: 5000                # optional, a further bound
///     memory_mb: 2048                 # optional, as the following
///     soil_draws: 100
///     progress_interval_s: 0.05
///     sweep: {speed_mps.max: [1, 2]}  # every combination of the values, keys as of `sweep_key`
///
/// A parameter of a planner that is a list stands for a planner for each of its values.
/// Files are relative to the suite; names have letters, digits, `_`, `-` and `.` only.
/// \param own_planners names that `planners` may have beside `planner_names()`
/// \throws SettingsError
Suite read_suite(const std::string& file, const std::vector<std::string>& own_planners = {});

/// The problem of a suite's scenario, or of any other sweep point of it, at a sweep point.
/// \throws InputError naming place and experiment where a value is not possible
PlanningProblem at_sweep_point(PlanningProblem problem, const Suite& suite, std::size_t scenario,
                               std::size_t sweep_point);

}  // namespace regoplan
