#pragma once

#include <ompl/base/Planner.h>

#include <string>

#include "planner/ompl/ompl_problem.h"

namespace regoplan {

/// A planner by its name (one of `planner_names()`, not `auto`), set up for the problem's scale.
/// \param problem must outlive it
ompl::base::PlannerPtr make_planner(const std::string& name, OmplProblem& problem);

}  // namespace regoplan
