#pragma once

#include <vector>

#include "planner/stages/plan_underway.h"
#include "planner/verdict/verified_path.h"

namespace regoplan {

/// The candidates: different ones of the verified paths, their controls optimised and verified
/// again where the problem asks for that and there is time.
std::vector<VerifiedPath> improved_choice(const PlanUnderway& plan,
                                          std::vector<VerifiedPath> paths);

}  // namespace regoplan
