#include "planner/ompl/steering_samplers.h"

#include <ompl/control/SpaceInformation.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "planner/ompl/ompl_problem.h"
#include "planner/ompl/vehicle_space.h"

namespace regoplan {
namespace {

namespace ob = ompl::base;
namespace oc = ompl::control;

/// A turn slips the wheels and tilted ground takes of the supply: not all that straight driving
/// leaves is there to turn with. Where straight driving has nothing to spare, turns are still
/// tried.
double turning_share(const World& world, double x_m, double y_m) {
  constexpr double kTurning = 0.8, kLeast = 0.05;
  return std::max(kLeast, kTurning * world.lateral_share(x_m, y_m));
}

}  // namespace

double fastest_turning_mps(const World& world, double x_m, double y_m) {
  const PlanningProblem& problem = world.problem();
  return std::sqrt(turning_share(world, x_m, y_m) * problem.gravity_mps2 /
                   problem.vehicle.curvature_max_1pm);
}

double curvature_reach_1pm(const World& world, double x_m, double y_m, double speed_mps) {
  const PlanningProblem& problem = world.problem();
  const double reach =
      turning_share(world, x_m, y_m) * problem.gravity_mps2 / std::max(speed_mps * speed_mps, 1e-9);
  return std::min(reach, problem.vehicle.curvature_max_1pm);
}

double drawn_speed_mps(const PlanningProblem& problem, ompl::RNG& random) {
  // Shares of the top speed; downhill the vehicle is faster than its rims, so they stay below it.
  constexpr double kLeastShare = 0.3, kCruiseShare = 0.93;
  const bool cruises = random.uniform01() < 0.5;
  return problem.speed_max_mps * (cruises ? kCruiseShare : random.uniformReal(kLeastShare, 1));
}

VehicleControl drawn_control(const World& world, const VehicleState& from, ompl::RNG& random) {
  const double speed = drawn_speed_mps(world.problem(), random);
  // Mostly gentle: the cube keeps straight driving likely.
  const double t = random.uniformReal(-1, 1);
  return {.speed_target_mps = speed,
          .curvature_target_1pm =
              curvature_reach_1pm(world, from.x_m, from.y_m, speed) * t * std::abs(t)};
}

CostToGo::Place aim(const World& world, const CostToGo& way, const VehicleState& state,
                    double speed_mps, ompl::RNG& random) {
  const double turning_radius_m = 1 / curvature_reach_1pm(world, state.x_m, state.y_m, speed_mps);
  return way.ahead(state.x_m, state.y_m, random.uniformReal(0.5, 1.5) * turning_radius_m);
}

VehicleControl control_toward(const World& world, const VehicleState& state, double x_m, double y_m,
                              double speed_mps) {
  const double reach = curvature_reach_1pm(world, state.x_m, state.y_m, speed_mps);
  return {.speed_target_mps = speed_mps,
          .curvature_target_1pm = pursuit_curvature_1pm(state, x_m, y_m, reach)};
}

double pursuit_curvature_1pm(const VehicleState& state, double x_m, double y_m,
                             double curvature_max_1pm) {
  const double dx = x_m - state.x_m, dy = y_m - state.y_m;
  const double c = std::cos(state.yaw_rad), s = std::sin(state.yaw_rad);
  const double ahead = c * dx + s * dy, aside = c * dy - s * dx;
  const double distance2 = dx * dx + dy * dy;
  if (distance2 == 0) return 0;
  if (ahead <= 0) return std::copysign(curvature_max_1pm, aside);
  return std::clamp(2 * aside / distance2, -curvature_max_1pm, curvature_max_1pm);
}

SteeringSampler::SteeringSampler(const oc::ControlSpace* space, const World& world,
                                 const CostToGo& way)
    : oc::ControlSampler(space), world_(world), way_(way) {}

void SteeringSampler::sample(oc::Control* control) {
  VehicleControlSpace::set(control, drawn_control(world_, world_.start(), rng_));
}

void SteeringSampler::sample(oc::Control* control, const ob::State* state) {
  if (rng_.uniform01() < 0.5) {
    VehicleControlSpace::set(control, drawn_control(world_, VehicleSpace::vehicle(state), rng_));
    return;
  }
  const double speed = drawn_speed_mps(world_.problem(), rng_);
  const CostToGo::Place place = aim(world_, way_, VehicleSpace::vehicle(state), speed, rng_);
  VehicleControlSpace::set(
      control, control_toward(world_, VehicleSpace::vehicle(state), place.x_m, place.y_m, speed));
}

void SteeringSampler::sampleNext(oc::Control* control, const oc::Control* /*previous*/,
                                 const ob::State* state) {
  sample(control, state);
}

PursuitSampler::PursuitSampler(const oc::SpaceInformation* si, OmplProblem& problem)
    : oc::DirectedControlSampler(si),
      problem_(problem),
      world_(problem.world()),
      way_(problem.way()) {}

unsigned int PursuitSampler::drive(const oc::Control* control, const ob::State* source,
                                   unsigned int steps, ob::State* result) const {
  ob::State* next = si_->allocState();
  si_->copyState(result, source);
  unsigned int done = 0;
  for (; done < steps; ++done) {
    si_->propagate(result, control, 1, next);
    if (!si_->isValid(next)) break;
    si_->copyState(result, next);
    if (world_.at_goal(VehicleSpace::vehicle(result))) {
      ++done;
      break;
    }
  }
  si_->freeState(next);
  return done;
}

unsigned int PursuitSampler::sampleTo(oc::Control* control, const ob::State* source,
                                      ob::State* target) {
  constexpr int kTries = 3;
  constexpr unsigned int kShortestMotion = 4;  // steps, unless it arrives
  constexpr double kGuided = 0.5, kAny = std::numeric_limits<double>::infinity();
  const PlanningProblem& problem = world_.problem();
  const VehicleState& from = VehicleSpace::vehicle(source);
  const CostToGo::Place place =
      rng_.uniform01() < kGuided
          ? aim(world_, way_, from, drawn_speed_mps(problem, rng_), rng_)
          : CostToGo::Place{VehicleSpace::vehicle(target).x_m, VehicleSpace::vehicle(target).y_m};
  const double away = std::hypot(place.x_m - from.x_m, place.y_m - from.y_m);
  ob::State* reached = si_->allocState();
  ob::State* best = si_->allocState();
  oc::Control* tried = si_->allocControl();
  unsigned int best_steps = 0;
  double best_distance = 0;
  for (int i = 0; i < kTries; ++i) {
    const bool free_try = i + 1 == kTries;
    const VehicleControl choice = free_try ? drawn_control(world_, from, rng_)
                                           : control_toward(world_, from, place.x_m, place.y_m,
                                                            drawn_speed_mps(problem, rng_));
    VehicleControlSpace::set(tried, choice);
    const double travel = std::max(choice.speed_target_mps, 1e-6) * si_->getPropagationStepSize();
    const auto steps =
        static_cast<unsigned int>(std::clamp(away / travel, static_cast<double>(kShortestMotion),
                                             static_cast<double>(si_->getMaxControlDuration())));
    const unsigned int done = drive(tried, source, steps, reached);
    const auto& values = *reached->as<VehicleSpace::StateType>();
    const bool arrived = done > 0 && problem_.arrival(values, values.cost, kAny).reached;
    if (done < kShortestMotion && !arrived) continue;
    const double distance = arrived ? 0
                                    : std::hypot(VehicleSpace::vehicle(reached).x_m - place.x_m,
                                                 VehicleSpace::vehicle(reached).y_m - place.y_m);
    if (best_steps == 0 || distance < best_distance) {
      best_steps = done;
      best_distance = distance;
      si_->copyState(best, reached);
      si_->copyControl(control, tried);
    }
  }
  if (best_steps > 0) si_->copyState(target, best);
  si_->freeControl(tried);
  si_->freeState(best);
  si_->freeState(reached);
  return best_steps;
}

unsigned int PursuitSampler::sampleTo(oc::Control* control, const oc::Control* /*previous*/,
                                      const ob::State* source, ob::State* target) {
  return sampleTo(control, source, target);
}

}  // namespace regoplan
