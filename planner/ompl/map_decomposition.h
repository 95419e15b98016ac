#pragma once

#include <ompl/base/Planner.h>
#include <ompl/control/planners/syclop/GridDecomposition.h>

#include <memory>

#include "planner/ompl/ompl_problem.h"

namespace regoplan {

/// The map in square regions, for planners that lead their tree from region to region.
std::shared_ptr<ompl::control::GridDecomposition> decomposition_of(const OmplProblem& problem);

/// OMPL's Syclop planners with the map's regions, led by `CostToGo`: a step from one region to the
/// next is as dear as the ground between them. Their `clear` drops what makes steps dear, so that a
/// second run would be led otherwise; these put it back.
/// \param problem must outlive them
ompl::base::PlannerPtr make_syclop_rrt(const OmplProblem& problem);
ompl::base::PlannerPtr make_syclop_est(const OmplProblem& problem);

}  // namespace regoplan
