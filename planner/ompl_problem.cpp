#include "planner/ompl_problem.h"

#include <ompl/base/goals/GoalSampleableRegion.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/control/PathControl.h>

#include <cmath>
#include <limits>

#include "planner/steering_samplers.h"
#include "planner/vehicle_space.h"

namespace regoplan {
namespace {

namespace ob = ompl::base;
namespace oc = ompl::control;

class DynamicsPropagator : public oc::StatePropagator {
 public:
  // A plain pointer: the space information owns the propagator.
  DynamicsPropagator(oc::SpaceInformation* si, const World& world, std::int64_t& propagations)
      : oc::StatePropagator(si), world_(world), propagations_(propagations) {}

  void propagate(const ob::State* state, const oc::Control* control, double duration,
                 ob::State* result) const override {
    const auto* from = state->as<VehicleSpace::StateType>();
    auto* to = result->as<VehicleSpace::StateType>();
    const StepResult step =
        world_.dynamics().step(from->vehicle, VehicleControlSpace::control(control), duration);
    ++propagations_;
    to->vehicle = step.state;
    to->strain = step.strain;
    // Off the known ground there is no dynamics: the state stays, and bounds or terrain tell why.
    to->possible = step.converged || !step.on_known_ground;
    if (!step.on_known_ground) leave_ground(*to, step.state, duration);
  }
  bool canPropagateBackward() const override { return false; }

 private:
  /// Rolls on straight to where the ground ends, so that validity sees it.
  static void leave_ground(VehicleSpace::StateType& to, const VehicleState& from, double duration) {
    const double travel = from.motion.vx_mps * duration;
    to.vehicle = from;
    to.vehicle.x_m += travel * std::cos(from.yaw_rad);
    to.vehicle.y_m += travel * std::sin(from.yaw_rad);
  }

  const World& world_;
  std::int64_t& propagations_;
};

class WorldValidity : public ob::StateValidityChecker {
 public:
  WorldValidity(ob::SpaceInformation* si, const World& world, double margin_min, RejectionLog& log)
      : ob::StateValidityChecker(si), world_(world), margin_min_(margin_min), log_(log) {}

  bool isValid(const ob::State* state) const override {
    const auto* typed = state->as<VehicleSpace::StateType>();
    auto rejection = world_.rejected(typed->vehicle, typed->strain, margin_min_);
    if (!rejection && !typed->possible) {
      rejection = RejectedState{.reason = Rejection::kSlip,
                                .x_m = typed->vehicle.x_m,
                                .y_m = typed->vehicle.y_m,
                                .yaw_rad = typed->vehicle.yaw_rad};
    }
    if (!rejection) return true;
    log_.add(*rejection);
    return false;
  }

 private:
  const World& world_;
  double margin_min_;
  RejectionLog& log_;
};

/// The goal of a problem, in metres and radians.
class VehicleGoal : public ob::GoalSampleableRegion {
 public:
  VehicleGoal(const ob::SpaceInformationPtr& si, const World& world)
      : ob::GoalSampleableRegion(si), world_(world), goal_(world.problem().goal) {
    setThreshold(0);
  }

  bool isSatisfied(const ob::State* state) const override {
    return world_.at_goal(state->as<VehicleSpace::StateType>()->vehicle);
  }
  bool isSatisfied(const ob::State* state, double* distance) const override {
    if (distance) *distance = distanceGoal(state);
    return isSatisfied(state);
  }
  double distanceGoal(const ob::State* state) const override {
    const VehicleState& v = state->as<VehicleSpace::StateType>()->vehicle;
    return std::hypot(v.x_m - goal_.x_m, v.y_m - goal_.y_m);
  }
  void sampleGoal(ob::State* state) const override {
    auto* typed = state->as<VehicleSpace::StateType>();
    const double speed = world_.problem().speed_max_mps;
    typed->vehicle = {.x_m = goal_.x_m,
                      .y_m = goal_.y_m,
                      .yaw_rad = goal_.heading_rad.value_or(0),
                      .motion = {.vx_mps = speed},
                      .rim_speed_mps = speed};
    typed->strain = {};
    typed->possible = true;
  }
  unsigned int maxSampleCount() const override { return std::numeric_limits<unsigned int>::max(); }

 private:
  const World& world_;
  const regoplan::Goal& goal_;
};

oc::SpaceInformationPtr space_of(const World& world) {
  const PlanningProblem& problem = world.problem();
  const double curvature_max = problem.vehicle.curvature_max_1pm;
  auto states = std::make_shared<VehicleSpace>(
      problem.map.elevation().frame, problem.speed_max_mps,
      VehicleSpace::Weights{.heading_m_per_rad = 1 / curvature_max, .speed_m = 1});
  auto controls = std::make_shared<VehicleControlSpace>(states, 0.1 * problem.speed_max_mps,
                                                        problem.speed_max_mps, curvature_max);
  return std::make_shared<oc::SpaceInformation>(states, controls);
}

}  // namespace

OmplProblem::OmplProblem(const World& world, const SearchGuidance& guidance)
    : world_(world),
      way_(world.problem(), guidance.variety, guidance.seed),
      rejections_(guidance.seed),
      space_(space_of(world)) {
  space_->getControlSpace()->setControlSamplerAllocator([this](const oc::ControlSpace* controls) {
    return std::make_shared<SteeringSampler>(controls, world_, way_);
  });
  space_->setDirectedControlSamplerAllocator([this](const oc::SpaceInformation* space) {
    return std::make_shared<PursuitSampler>(space, world_, way_);
  });
  space_->setStatePropagator(
      std::make_shared<DynamicsPropagator>(space_.get(), world, propagations_));
  space_->setStateValidityChecker(
      std::make_shared<WorldValidity>(space_.get(), world, guidance.margin_min, rejections_));
  space_->setPropagationStepSize(world.search_step_s());
  space_->setMinMaxControlDuration(1, 24);
  space_->setup();
}

void OmplProblem::pose(ob::ProblemDefinition& definition) const {
  ob::State* start = space_->allocState();
  start->as<VehicleSpace::StateType>()->vehicle = world_.start();
  definition.addStartState(start);
  space_->freeState(start);
  definition.setGoal(std::make_shared<VehicleGoal>(space_, world_));
  auto objective = std::make_shared<ob::PathLengthOptimizationObjective>(space_);
  // SST stops at the first path: by default it would use all its time.
  objective->setCostThreshold(ob::Cost(std::numeric_limits<double>::max()));
  definition.setOptimizationObjective(objective);
}

double OmplProblem::diagonal_m() const {
  const GridFrame& frame = world_.problem().map.elevation().frame;
  return std::hypot(frame.east_m() - frame.west_m, frame.north_m - frame.south_m());
}

std::vector<ControlSegment> exact_solution(const ob::ProblemDefinition& definition) {
  if (!definition.hasExactSolution()) return {};
  const auto& path = *definition.getSolutionPath()->as<oc::PathControl>();
  std::vector<ControlSegment> segments;
  for (std::size_t i = 0; i < path.getControlCount(); ++i) {
    const VehicleControl control =
        VehicleControlSpace::control(path.getControl(static_cast<unsigned int>(i)));
    const double duration = path.getControlDuration(static_cast<unsigned int>(i));
    if (duration <= 0) continue;
    segments.push_back({.duration_s = duration,
                        .speed_target_mps = control.speed_target_mps,
                        .curvature_target_1pm = control.curvature_target_1pm});
  }
  return segments;
}

}  // namespace regoplan
