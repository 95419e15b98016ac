#include "planner/ompl/state_cost.h"

#include <ompl/control/PathControl.h>

#include <algorithm>
#include <limits>

#include "planner/ompl/iteration_termination.h"
#include "planner/ompl/ompl_planners.h"
#include "planner/ompl/path_cost.h"

namespace regoplan {
namespace {

namespace ob = ompl::base;

/// The drives of a path up to where it reaches the goal, and what they cost.
struct DrivesToGoal {
  std::vector<Drive> drives;
  double cost = std::numeric_limits<double>::infinity();  ///< finite where it does
};

DrivesToGoal driven(OmplProblem& problem, const VehicleSpace::Values& start,
                    const std::vector<ControlSegment>& controls) {
  DrivesToGoal path;
  VehicleSpace::Values values = start;
  double cost = 0;
  for (const Drive& drive : drives_of(controls, problem.step_s())) {
    path.drives.push_back({.control = drive.control});
    for (int i = 0; i < drive.steps; ++i) {
      const SearchStep step = problem.steps().next(values, drive.control, problem.step_s());
      cost += step_cost(problem.world(), values, step, problem.step_s());
      values = step.values;
      ++path.drives.back().steps;
      if (!problem.world().at_goal(values.vehicle)) continue;
      path.cost = cost;
      return path;
    }
  }
  return path;
}

}  // namespace

StateCost::StateCost(OmplProblem& problem)
    : ob::Planner(problem.space(), "StateCost"), problem_(problem), improves_(problem.improves()) {
  specs_.optimizingPaths = true;
  specs_.directed = true;
  addPlannerProgressProperty("best cost REAL", [this] { return std::to_string(best_.cost()); });
  addPlannerProgressProperty("rounds INTEGER", [this] { return std::to_string(rounds_.load()); });
  params_.declareParam<std::string>(
      "inner", [this](const std::string& name) { inner_ = {name}; },
      [this] { return inner_.front(); });
}

void StateCost::clear() {
  Planner::clear();
  best_.clear();
  rounds_ = 0;
}

bool StateCost::round(const ob::PlannerTerminationCondition& stop, const std::string& inner,
                      unsigned int iterations) {
  ++rounds_;
  problem_.accept_first_below(best_.cost());
  const auto definition = std::make_shared<ob::ProblemDefinition>(problem_.space());
  problem_.pose(*definition);
  const ob::PlannerPtr planner = make_planner(inner, problem_);
  planner->setProblemDefinition(definition);
  planner->setup();
  ob::IterationTerminationCondition share(iterations);
  planner->solve(ob::plannerOrTerminationCondition(stop, share));
  DrivesToGoal path = driven(problem_, start_, exact_solution(*definition));
  return best_.offer(path.cost, std::move(path.drives));
}

ob::PlannerStatus StateCost::solve(const ob::PlannerTerminationCondition& stop) {
  checkValidity();
  while (const ob::State* start = pis_.nextStart()) {
    start_ = *start->as<VehicleSpace::StateType>();
  }
  constexpr unsigned int kFirstShare = 2000, kLargestShare = 1U << 30;
  unsigned int share = kFirstShare;
  bool got_on = true;  // since every inner planner last had its turn
  for (std::size_t turn = 0; !stop && (improves_ || !best_.found());) {
    const bool better = round(stop, inner_[turn], share);
    if (better) announce(*this, problem_, start_, best_);
    got_on = got_on || better;
    if (better) continue;  // who gets on goes on
    turn = (turn + 1) % inner_.size();
    if (turn != 0) continue;
    if (!got_on) share = std::min(2 * share, kLargestShare);
    got_on = false;
  }
  if (!best_.found()) return ob::PlannerStatus::TIMEOUT;
  enter_solution(*this, problem_, start_, best_);
  return ob::PlannerStatus::EXACT_SOLUTION;
}

}  // namespace regoplan
