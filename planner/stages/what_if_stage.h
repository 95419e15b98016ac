#pragma once

#include <vector>

#include "planner/stages/plan_underway.h"
#include "planner/verdict/verified_path.h"

namespace regoplan {

/// What would become of the best path in other circumstances, as far as time allows; where it is
/// doubtful first how slowly it would have to be driven.
std::vector<WhatIf> answered_what_ifs(const PlanUnderway& plan, const VerifiedPath& best);

}  // namespace regoplan
