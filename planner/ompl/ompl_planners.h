#pragma once

#include <ompl/base/Planner.h>

#include <functional>
#include <map>
#include <string>

#include "planner/ompl/ompl_problem.h"

namespace regoplan {

/// Makes a planner over `problem.space()`. The problem outlives it.
using PlannerMaker = std::function<ompl::base::PlannerPtr(OmplProblem& problem)>;

/// Planners of one's own, by the names under which they are asked for.
using OwnPlanners = std::map<std::string, PlannerMaker>;

/// A planner by its name (one of `planner_names()`, not `auto`, or of `own`), set up for the
/// problem's scale.
/// \param problem must outlive it
/// \throws InputError for another name, listing these, or where an own planner's maker gives none
ompl::base::PlannerPtr make_planner(const std::string& name, OmplProblem& problem,
                                    const OwnPlanners& own = {});

}  // namespace regoplan
