#include "planner/search_run.h"

#include <ompl/base/goals/GoalSampleableRegion.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/base/terminationconditions/IterationTerminationCondition.h>
#include <ompl/control/PathControl.h>
#include <ompl/control/SpaceInformation.h>
#include <ompl/control/planners/est/EST.h>
#include <ompl/control/planners/kpiece/KPIECE1.h>
#include <ompl/control/planners/pdst/PDST.h>
#include <ompl/control/planners/rrt/RRT.h>
#include <ompl/control/planners/sst/SST.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "planner/steering_samplers.h"
#include "planner/vehicle_space.h"

namespace regoplan {
namespace {

namespace ob = ompl::base;
namespace oc = ompl::control;

/// Keeps an even sample of the rejected states, of each reason on its own.
class RejectionLog {
 public:
  explicit RejectionLog(std::uint64_t seed) : random_(seed) {}

  void add(const RejectedState& state) {
    const auto reason = static_cast<std::size_t>(state.reason);
    const auto seen = static_cast<std::uint64_t>(counts_[reason]++);
    std::vector<RejectedState>& kept = samples_[reason];
    if (kept.size() < kKept) {
      kept.push_back(state);
      return;
    }
    const std::uint64_t place = std::uniform_int_distribution<std::uint64_t>(0, seen)(random_);
    if (place < kKept) kept[place] = state;
  }

  const std::array<std::int64_t, kRejectionCount>& counts() const { return counts_; }
  std::vector<RejectedState> sample() const {
    std::vector<RejectedState> all;
    for (const auto& kept : samples_) all.insert(all.end(), kept.begin(), kept.end());
    return all;
  }

 private:
  static constexpr std::size_t kKept = 30;
  std::mt19937_64 random_;
  std::array<std::int64_t, kRejectionCount> counts_{};
  std::array<std::vector<RejectedState>, kRejectionCount> samples_;
};

class DynamicsPropagator : public oc::StatePropagator {
 public:
  // A plain pointer: the space information owns the propagator.
  DynamicsPropagator(oc::SpaceInformation* si, const World& world)
      : oc::StatePropagator(si), world_(world) {}

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
  std::int64_t propagations() const { return propagations_; }

 private:
  /// Rolls on straight to where the ground ends, so that validity sees it.
  static void leave_ground(VehicleSpace::StateType& to, const VehicleState& from, double duration) {
    const double travel = from.motion.vx_mps * duration;
    to.vehicle = from;
    to.vehicle.x_m += travel * std::cos(from.yaw_rad);
    to.vehicle.y_m += travel * std::sin(from.yaw_rad);
  }

  const World& world_;
  mutable std::int64_t propagations_ = 0;
};

class WorldValidity : public ob::StateValidityChecker {
 public:
  WorldValidity(ob::SpaceInformation* si, const World& world, const SearchRun& run)
      : ob::StateValidityChecker(si), world_(world), margin_min_(run.margin_min), log_(run.seed) {}

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
  const RejectionLog& log() const { return log_; }

 private:
  const World& world_;
  double margin_min_;
  mutable RejectionLog log_;
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

ob::PlannerPtr planner_named(const std::string& name, const oc::SpaceInformationPtr& si,
                             double map_size_m) {
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

std::vector<ControlSegment> segments_of(const oc::PathControl& path) {
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

}  // namespace

SearchOutcome search(const World& world, const SearchRun& run) {
  ompl::msg::noOutputHandler();
  ompl::RNG::setSeed(static_cast<std::uint_fast32_t>(run.seed % 4294967291u + 1));
  const PlanningProblem& problem = world.problem();
  const GridFrame& frame = problem.map.elevation().frame;

  const CostToGo way(problem, run.variety, run.seed);

  auto states = std::make_shared<VehicleSpace>(
      frame, problem.speed_max_mps,
      VehicleSpace::Weights{.heading_m_per_rad = 1 / problem.vehicle.curvature_max_1pm,
                            .speed_m = 1});
  auto controls = std::make_shared<VehicleControlSpace>(states, 0.1 * problem.speed_max_mps,
                                                        problem.speed_max_mps,
                                                        problem.vehicle.curvature_max_1pm);
  controls->setControlSamplerAllocator([&world, &way](const oc::ControlSpace* space) {
    return std::make_shared<SteeringSampler>(space, world, way);
  });
  auto si = std::make_shared<oc::SpaceInformation>(states, controls);
  auto propagator = std::make_shared<DynamicsPropagator>(si.get(), world);
  auto validity = std::make_shared<WorldValidity>(si.get(), world, run);
  si->setStatePropagator(propagator);
  si->setStateValidityChecker(validity);
  si->setDirectedControlSamplerAllocator([&world, &way](const oc::SpaceInformation* info) {
    return std::make_shared<PursuitSampler>(info, world, way);
  });
  si->setPropagationStepSize(world.search_step_s());
  si->setMinMaxControlDuration(1, 24);
  si->setup();

  auto definition = std::make_shared<ob::ProblemDefinition>(si);
  ob::State* start = si->allocState();
  start->as<VehicleSpace::StateType>()->vehicle = world.start();
  definition->addStartState(start);
  si->freeState(start);
  definition->setGoal(std::make_shared<VehicleGoal>(si, world));
  auto objective = std::make_shared<ob::PathLengthOptimizationObjective>(si);
  // SST stops at the first path: by default it would use all its time.
  objective->setCostThreshold(ob::Cost(std::numeric_limits<double>::max()));
  definition->setOptimizationObjective(objective);

  const double map_size =
      std::hypot(frame.east_m() - frame.west_m, frame.north_m - frame.south_m());
  const ob::PlannerPtr planner = planner_named(run.planner, si, map_size);
  planner->setProblemDefinition(definition);
  planner->setup();
  ob::IterationTerminationCondition iterations(
      static_cast<unsigned int>(run.iterations.value_or(std::numeric_limits<int>::max())));
  const ob::PlannerTerminationCondition bound =
      run.iterations ? ob::PlannerTerminationCondition(iterations)
                     : ob::timedPlannerTerminationCondition(*run.time_s);
  const ob::PlannerStatus status = planner->solve(bound);

  SearchOutcome outcome{.controls = {},
                        .rejected = validity->log().counts(),
                        .rejected_states = validity->log().sample(),
                        .propagations = propagator->propagations()};
  if (status == ob::PlannerStatus::EXACT_SOLUTION) {
    outcome.controls = segments_of(*definition->getSolutionPath()->as<oc::PathControl>());
  }
  return outcome;
}

}  // namespace regoplan
