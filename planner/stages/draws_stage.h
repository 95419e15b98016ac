#pragma once

#include <vector>

#include "planner/stages/plan_underway.h"
#include "planner/verdict/verified_path.h"

namespace regoplan {

/// Judges the candidates over draws of the soils, as many of each as time allows. Beside the draws
/// it works out what else the answer needs and nothing waits for: the bound of the duration and the
/// rasters of the map.
/// \param chosen each gets its spread \param result takes the bound and the rasters
void draw_soils(const PlanUnderway& plan, std::vector<VerifiedPath>& chosen, PlanResult& result);

}  // namespace regoplan
