#pragma once

#include <string>
#include <vector>

#include "planner/evaluation/manoeuvres.h"

namespace regoplan {

/// Reads a YAML list of manoeuvres `{kind, name, vehicle, soil, speed_mps, slope_deg,
/// slope_heading_deg, turn, ...}`. Vehicle, soil and speed are those of the scenario where they are
/// not given; `vehicle`, `soil`, `speed_mps` and `slope_deg` may be lists: the manoeuvre then
/// stands for each combination.
/// \throws SettingsError
std::vector<Manoeuvre> read_manoeuvres(const std::string& file, const PlanningProblem& problem);

}  // namespace regoplan
