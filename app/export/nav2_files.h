#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "app/io/staged_files.h"
#include "planner/problem/planning_problem.h"
#include "planner/problem/terrain_rasters.h"

namespace regoplan {

/// `keepout.pgm`, `keepout.yaml`: occupied where no steady driving keeps the least margin, where
/// the ground is unknown or steeper than allowed, and where a rock is that cannot be passed over.
/// `speed.pgm`, `speed.yaml`: per cent of the scenario's top speed up to which a cell can be
/// driven; 0, no limit, where that is all of it. Both in map coordinates, cells as of the rasters.
/// \throws InputError where cells are not square
std::vector<RenderedFile> nav2_masks(const PlanningProblem& problem, const TerrainRasters& rasters);

/// `route.geojson`: a path as a graph for the route server, nodes at equal distances along it, at
/// most `spacing_m` apart.
/// \param candidate its candidate-K.geojson
RenderedFile nav2_route(const nlohmann::ordered_json& candidate, double spacing_m);

}  // namespace regoplan
