#pragma once

#include "planner/problem/planning_problem.h"
#include "planner/problem/terrain_rasters.h"

namespace regoplan {

/// By the direct wheel model at its fast accuracy on planes of whole degrees (supply: every fifth)
/// of each soil, linear between them; the ground of a cell is the plane under the vehicle
/// that stands in it, heading east. Soils count with their means. Of maps with more than 1024 cells
/// a side every so manieth is taken, with cells as much larger.
TerrainRasters terrain_rasters(const PlanningProblem& problem);

/// `TerrainRasters::probability` on the same grid, over 20 draws of the soils: the share of draws
/// that bear the slope of a cell, in whole degrees.
std::vector<float> straight_on_probability(const PlanningProblem& problem);

}  // namespace regoplan
