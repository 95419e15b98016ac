#pragma once

#include <nlohmann/json_fwd.hpp>

#include "planner/problem/planning_problem.h"

namespace regoplan {

/// What a problem is planned with, defaults and the command line's word included, under the keys of
/// a SCENARIO.yaml: beside a `map`, it reads back to the same problem bit for bit.
nlohmann::ordered_json effective_settings(const PlanningProblem& problem);

/// A vehicle as its file has it.
nlohmann::ordered_json vehicle_file_json(const Vehicle& vehicle);

/// The limits alone, under their keys.
nlohmann::ordered_json limits_json(const Limits& limits);

}  // namespace regoplan
