#include "planner/ompl/drive.h"

#include <ompl/control/PathControl.h>

#include <algorithm>
#include <cmath>

namespace regoplan {
namespace {

namespace ob = ompl::base;
namespace oc = ompl::control;

/// Drives again: the dynamics are deterministic, so these are the states that the search had.
std::shared_ptr<oc::PathControl> path_of(const OmplProblem& problem,
                                         const VehicleSpace::Values& start,
                                         const std::vector<Drive>& drives) {
  const oc::SpaceInformationPtr& space = problem.space();
  const double step_s = space->getPropagationStepSize();
  auto path = std::make_shared<oc::PathControl>(space);
  ob::State* state = space->allocState();
  oc::Control* control = space->allocControl();
  auto& values = static_cast<VehicleSpace::Values&>(*state->as<VehicleSpace::StateType>());
  values = start;
  path->append(state);
  for (const Drive& drive : drives) {
    for (int i = 0; i < drive.steps; ++i) {
      const StepResult step =
          problem.world().dynamics().step(values.vehicle, drive.control, step_s);
      values = {.vehicle = step.state, .strain = step.strain, .possible = step.converged};
    }
    VehicleControlSpace::set(control, drive.control);
    path->append(state, control, drive.steps * step_s);
  }
  space->freeControl(control);
  space->freeState(state);
  return path;
}

}  // namespace

std::vector<Drive> drives_to(const std::vector<DriveNode>& nodes, int node) {
  std::vector<Drive> drives;
  for (int at = node; nodes[static_cast<std::size_t>(at)].parent != DriveNode::kRoot;
       at = nodes[static_cast<std::size_t>(at)].parent) {
    drives.push_back(nodes[static_cast<std::size_t>(at)].drive);
  }
  std::reverse(drives.begin(), drives.end());
  return drives;
}

std::vector<ControlSegment> controls_of(const std::vector<Drive>& drives, double step_s) {
  std::vector<ControlSegment> controls;
  for (const Drive& drive : drives) {
    controls.push_back({.duration_s = drive.steps * step_s,
                        .speed_target_mps = drive.control.speed_target_mps,
                        .curvature_target_1pm = drive.control.curvature_target_1pm});
  }
  return controls;
}

std::vector<Drive> drives_of(const std::vector<ControlSegment>& controls, double step_s) {
  std::vector<Drive> drives;
  for (const ControlSegment& segment : controls) {
    drives.push_back({.control = {.speed_target_mps = segment.speed_target_mps,
                                  .curvature_target_1pm = segment.curvature_target_1pm},
                      .steps = static_cast<int>(std::lround(segment.duration_s / step_s))});
  }
  return drives;
}

void BestPath::clear() {
  cost_ = std::numeric_limits<double>::infinity();
  drives_.clear();
}

bool BestPath::offer(double cost, std::vector<Drive> drives) {
  if (!(cost < cost_)) return false;
  cost_ = cost;
  drives_ = std::move(drives);
  return true;
}

void announce(const ob::Planner& planner, const OmplProblem& problem,
              const VehicleSpace::Values& start, const BestPath& best) {
  const auto& listener = planner.getProblemDefinition()->getIntermediateSolutionCallback();
  if (!listener) return;
  const auto path = path_of(problem, start, best.drives());
  listener(&planner, {path->getStates().begin(), path->getStates().end()}, ob::Cost(best.cost()));
}

void enter_solution(const ob::Planner& planner, const OmplProblem& problem,
                    const VehicleSpace::Values& start, const BestPath& best) {
  planner.getProblemDefinition()->addSolutionPath(path_of(problem, start, best.drives()), false, 0,
                                                  planner.getName());
}

}  // namespace regoplan
