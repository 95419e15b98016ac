#include "planner/ompl/ompl_planners.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <ompl/control/planners/est/EST.h>
#include <ompl/control/planners/kpiece/KPIECE1.h>
#include <ompl/control/planners/pdst/PDST.h>
#include <ompl/control/planners/rrt/RRT.h>
#include <ompl/control/planners/sst/SST.h>

#include <algorithm>

#include "planner/ompl/lattice.h"
#include "planner/ompl/map_decomposition.h"
#include "planner/ompl/stable_sparse.h"
#include "planner/ompl/state_cost.h"
#include "terramech/basics/input_error.h"

namespace regoplan {

namespace ob = ompl::base;
namespace oc = ompl::control;

namespace {

/// OMPL 1.5.2's SST deletes its witnesses, but neither their states nor their controls.
class Sst : public oc::SST {
 public:
  using oc::SST::SST;
  ~Sst() override { free_witnesses(); }

  void clear() override {
    free_witnesses();
    oc::SST::clear();
  }

 private:
  void free_witnesses() {
    if (!witnesses_) return;
    std::vector<Motion*> witnesses;
    witnesses_->list(witnesses);
    for (Motion* witness : witnesses) {
      si_->freeState(witness->state_);
      siC_->freeControl(witness->control_);
      witness->state_ = nullptr;
      witness->control_ = nullptr;
    }
  }
};

/// How far the longest motion gets from standstill.
double longest_first_motion_m(const OmplProblem& problem) {
  const PlanningProblem& asked = problem.world().problem();
  const double time_s = problem.space()->getMaxControlDuration() * problem.step_s();
  const double a = asked.vehicle.acceleration_max_mps2;
  const double rising_s = std::min(time_s, asked.speed_max_mps / a);
  return a * rising_s * rising_s / 2 + asked.speed_max_mps * (time_s - rising_s);
}

}  // namespace

ob::PlannerPtr make_planner(const std::string& name, OmplProblem& problem, const OwnPlanners& own) {
  if (const auto mine = own.find(name); mine != own.end()) {
    ob::PlannerPtr planner = mine->second ? mine->second(problem) : nullptr;
    if (!planner) throw InputError(name + ": its maker gives no planner");
    return planner;
  }
  const oc::SpaceInformationPtr& si = problem.space();
  const double map_size_m = problem.diagonal_m();
  if (name == "Lattice") return std::make_shared<Lattice>(problem);
  if (name == "StableSparse") return std::make_shared<StableSparse>(problem);
  if (name == "StateCost") return std::make_shared<StateCost>(problem);
  if (name == "SyclopRRT") return make_syclop_rrt(problem);
  if (name == "SyclopEST") return make_syclop_est(problem);
  if (name == "SST") {
    auto sst = std::make_shared<Sst>(si);
    // Where a whole motion ends within the pruning radius of its start, the tree never leaves it.
    const double pruning_m = 0.3 * longest_first_motion_m(problem);
    sst->setSelectionRadius(5 * pruning_m);
    sst->setPruningRadius(pruning_m);
    sst->setGoalBias(0.05);
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
  if (name == "PDST") {
    auto pdst = std::make_shared<oc::PDST>(si);
    pdst->setGoalBias(0.1);
    return pdst;
  }
  std::vector<std::string> known = planner_names();
  std::erase(known, "auto");
  for (const auto& [mine, maker] : own) known.push_back(mine);
  throw InputError(
      fmt::format("planner.name: {} is not known (allowed: {})", name, fmt::join(known, ", ")));
}

}  // namespace regoplan
