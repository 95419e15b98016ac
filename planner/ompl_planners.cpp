#include "planner/ompl_planners.h"

#include <ompl/control/planners/est/EST.h>
#include <ompl/control/planners/kpiece/KPIECE1.h>
#include <ompl/control/planners/pdst/PDST.h>
#include <ompl/control/planners/rrt/RRT.h>
#include <ompl/control/planners/sst/SST.h>

#include "planner/lattice.h"
#include "planner/map_decomposition.h"
#include "planner/stable_sparse.h"
#include "planner/state_cost.h"

namespace regoplan {

namespace ob = ompl::base;
namespace oc = ompl::control;

ob::PlannerPtr make_planner(const std::string& name, OmplProblem& problem) {
  const oc::SpaceInformationPtr& si = problem.space();
  const double map_size_m = problem.diagonal_m();
  if (name == "Lattice") return std::make_shared<Lattice>(problem);
  if (name == "StableSparse") return std::make_shared<StableSparse>(problem);
  if (name == "StateCost") return std::make_shared<StateCost>(problem);
  if (name == "SyclopRRT") return make_syclop_rrt(problem);
  if (name == "SyclopEST") return make_syclop_est(problem);
  if (name == "SST") {
    auto sst = std::make_shared<oc::SST>(si);
    sst->setSelectionRadius(0.04 * map_size_m);
    sst->setPruningRadius(0.01 * map_size_m);
    sst->setGoalBias(0.1);
    return sst;
  }
  if (name == "RRT") {
    auto rrt = std::make_shared<oc::RRT>(si);
    rrt->setGoalBias(0.1);
    rrt->setIntermediateStates(false);
    return rrt;
  }
  if (name == "KPIECE1") return std::make_shared<oc::KPIECE1>(si);
  if (name == "EST") {
    auto est = std::make_shared<oc::EST>(si);
    est->setGoalBias(0.1);
    est->setRange(0.1 * map_size_m);
    return est;
  }
  auto pdst = std::make_shared<oc::PDST>(si);
  pdst->setGoalBias(0.1);
  return pdst;
}

}  // namespace regoplan
