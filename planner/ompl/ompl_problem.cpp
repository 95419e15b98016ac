#include "planner/ompl/ompl_problem.h"

#include <ompl/base/goals/GoalSampleableRegion.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/control/PathControl.h>
#include <ompl/util/RandomNumbers.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "planner/certificate/steepest_climb.h"
#include "planner/ompl/muted_ompl.h"
#include "planner/ompl/path_cost.h"
#include "planner/ompl/steering_samplers.h"
#include "planner/ompl/vehicle_space.h"

namespace regoplan {
namespace {

namespace ob = ompl::base;
namespace oc = ompl::control;

class DynamicsPropagator : public oc::StatePropagator {
 public:
  // A plain pointer: the space information owns the propagator.
  DynamicsPropagator(oc::SpaceInformation* si, const World& world, SearchSteps& steps)
      : oc::StatePropagator(si), world_(world), steps_(steps) {}

  void propagate(const ob::State* state, const oc::Control* control, double duration,
                 ob::State* result) const override {
    const auto* from = state->as<VehicleSpace::StateType>();
    auto* to = result->as<VehicleSpace::StateType>();
    SearchStep step = steps_.next(*from, VehicleControlSpace::control(control), duration);
    step.values.cost = from->cost + step_cost(world_, *from, step, duration);
    static_cast<VehicleSpace::Values&>(*to) = step.values;
  }
  bool canPropagateBackward() const override { return false; }

 private:
  const World& world_;
  SearchSteps& steps_;
};

class WorldValidity : public ob::StateValidityChecker {
 public:
  WorldValidity(ob::SpaceInformation* si, const OmplProblem& problem, SearchSteps& steps)
      : ob::StateValidityChecker(si), problem_(problem), steps_(steps) {}

  bool isValid(const ob::State* state) const override {
    const auto* values = state->as<VehicleSpace::StateType>();
    constexpr double kAny = std::numeric_limits<double>::infinity();
    return !problem_.hopeless(values->cost, values->vehicle, kAny) && steps_.allowed(*values);
  }

 private:
  const OmplProblem& problem_;
  SearchSteps& steps_;
};

/// The goal of a problem, in metres and radians: the states from which the vehicle arrives there.
class VehicleGoal : public ob::GoalSampleableRegion {
 public:
  VehicleGoal(const ob::SpaceInformationPtr& si, OmplProblem& problem)
      : ob::GoalSampleableRegion(si),
        problem_(problem),
        world_(problem.world()),
        goal_(world_.problem().goal) {
    setThreshold(0);
  }

  Arrival arrival(const ob::State* state) const {
    constexpr double kAny = std::numeric_limits<double>::infinity();
    const auto* values = state->as<VehicleSpace::StateType>();
    return problem_.arrival(*values, values->cost, kAny);
  }
  bool isSatisfied(const ob::State* state) const override { return arrival(state).reached; }
  bool isSatisfied(const ob::State* state, double* distance) const override {
    if (distance) *distance = distanceGoal(state);
    return isSatisfied(state);
  }
  double distanceGoal(const ob::State* state) const override {
    const VehicleState& v = VehicleSpace::vehicle(state);
    return std::hypot(v.x_m - goal_.x_m, v.y_m - goal_.y_m);
  }
  /// A state that may well be: at half of the speed that is allowed, any place and heading that
  /// counts.
  void sampleGoal(ob::State* state) const override {
    constexpr double kLikelySpeedShare = 0.5;
    const double speed_max_mps = std::min(goal_.speed_max_mps, world_.problem().speed_max_mps);
    const double share = World::kSearchGoalShare;
    const double away_m = share * goal_.radius_m * std::sqrt(random_.uniform01());
    const double aside_rad = random_.uniformReal(-std::numbers::pi, std::numbers::pi);
    const double turn = random_.uniformReal(-1, 1);
    const double heading_rad = goal_.heading_rad
                                   ? *goal_.heading_rad + share * turn * goal_.heading_tolerance_rad
                                   : turn * std::numbers::pi;
    auto* typed = state->as<VehicleSpace::StateType>();
    typed->vehicle = world_.dynamics().rolling_state(
        goal_.x_m + away_m * std::cos(aside_rad), goal_.y_m + away_m * std::sin(aside_rad),
        heading_rad, kLikelySpeedShare * speed_max_mps);
    typed->strain = {};
    typed->possible = true;
    const auto& cost_axis = si_->getStateSpace()->as<VehicleSpace>()->cost_axis();
    typed->cost = cost_axis ? random_.uniformReal(0, cost_axis->below) : 0;
  }
  unsigned int maxSampleCount() const override { return std::numeric_limits<unsigned int>::max(); }

 private:
  OmplProblem& problem_;
  const World& world_;
  const regoplan::Goal& goal_;
  mutable ompl::RNG random_;
};

std::shared_ptr<VehicleSpace> states_of(const PlanningProblem& problem) {
  return std::make_shared<VehicleSpace>(
      problem.map.elevation().frame, problem.speed_max_mps,
      VehicleSpace::Weights{.heading_m_per_rad = 1 / problem.vehicle.curvature_max_1pm,
                            .speed_m = 1});
}

// Zero would have OMPL draw a seed of its own.
std::uint_fast32_t ompl_seed(std::uint64_t seed) {
  constexpr std::uint64_t kLargestPrimeBelow32Bits = 4294967291;
  return static_cast<std::uint_fast32_t>(seed % kLargestPrimeBelow32Bits + 1);
}

oc::SpaceInformationPtr space_of(const PlanningProblem& problem,
                                 const std::shared_ptr<VehicleSpace>& states) {
  const double curvature_max = problem.vehicle.curvature_max_1pm;
  auto controls = std::make_shared<VehicleControlSpace>(states, 0.1 * problem.speed_max_mps,
                                                        problem.speed_max_mps, curvature_max);
  return std::make_shared<oc::SpaceInformation>(states, controls);
}

}  // namespace

OmplProblem::OmplProblem(const World& world, const SearchGuidance& guidance)
    : world_(world),
      way_(world.problem(), steepest_climbs_rad(world), guidance.variety, guidance.seed),
      steps_(world, guidance.margin_min, guidance.seed),
      seed_(ompl_seed(guidance.seed)),
      improves_(guidance.improve),
      states_(states_of(world.problem())),
      space_(space_of(world.problem(), states_)) {
  {
    // Of a second seed OMPL says that it changes nothing; it does, and what is made from here on
    // draws from it.
    const MutedOmpl muted;
    ompl::RNG::setSeed(seed_);
  }
  space_->getControlSpace()->setControlSamplerAllocator([this](const oc::ControlSpace* controls) {
    return std::make_shared<SteeringSampler>(controls, world_, way_);
  });
  space_->setDirectedControlSamplerAllocator([this](const oc::SpaceInformation* space) {
    return std::make_shared<PursuitSampler>(space, *this);
  });
  space_->setStatePropagator(std::make_shared<DynamicsPropagator>(space_.get(), world_, steps_));
  space_->setStateValidityChecker(std::make_shared<WorldValidity>(space_.get(), *this, steps_));
  space_->setPropagationStepSize(world.search_step_s());
  space_->setMinMaxControlDuration(1, 24);
  space_->setup();
}

void OmplProblem::pose(ob::ProblemDefinition& definition) {
  ob::State* start = space_->allocState();
  start->as<VehicleSpace::StateType>()->vehicle = world_.start();
  definition.addStartState(start);
  space_->freeState(start);
  definition.setGoal(std::make_shared<VehicleGoal>(space_, *this));
  auto objective = std::make_shared<ob::PathLengthOptimizationObjective>(space_);
  // By default a threshold is 0, which no path reaches: the search would use all its time.
  objective->setCostThreshold(ob::Cost(improves_ ? 0 : std::numeric_limits<double>::max()));
  definition.setOptimizationObjective(objective);
}

void OmplProblem::accept_first_below(double cost) {
  improves_ = false;
  ++seed_;  // what a planner drew in vain it need not draw again
  cost_below_ = cost;
  if (!std::isfinite(cost)) return;
  // As long as the way that it pays for, were it driven at top speed; half of that, for place and
  // heading to lead.
  constexpr double kShare = 0.5;
  const PlanningProblem& problem = world_.problem();
  const double per_metre = rough_cost(problem, 1, 1 / problem.speed_max_mps);
  states_->set_cost_axis({.below = cost, .metres = kShare / per_metre});
}

bool OmplProblem::hopeless(double cost, const VehicleState& state, double best_cost) const {
  const double below = std::min(best_cost, cost_below_);
  if (!std::isfinite(below)) return false;
  if (!least_length_) least_length_.emplace(world_.problem());
  return cost + least_cost(world_.problem(), least_length_->to_goal_m(state.x_m, state.y_m)) >=
         below;
}

Arrival OmplProblem::arrival(const VehicleSpace::Values& from, double cost, double best_cost) {
  // About a drive ahead: where searches have a node, there is one near enough.
  constexpr double kHold_radii = 2;
  const PlanningProblem& problem = world_.problem();
  return arrival_from(steps_, from,
                      {.hold_max_m = kHold_radii / problem.vehicle.curvature_max_1pm,
                       .cost_below = std::min(best_cost, cost_below_) - cost});
}

double OmplProblem::diagonal_m() const {
  const GridFrame& frame = world_.problem().map.elevation().frame;
  return std::hypot(frame.east_m() - frame.west_m, frame.north_m - frame.south_m());
}

std::vector<ControlSegment> exact_solution(const ob::ProblemDefinition& definition) {
  if (!definition.hasExactSolution()) return {};
  auto& path = *definition.getSolutionPath()->as<oc::PathControl>();
  const auto& goal = *dynamic_cast<const VehicleGoal*>(definition.getGoal().get());
  const Arrival arrival = goal.arrival(path.getStates().back());
  if (!arrival.reached) return {};
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
  segments.insert(segments.end(), arrival.controls.begin(), arrival.controls.end());
  return segments;
}

}  // namespace regoplan
