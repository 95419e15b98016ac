#include "planner/ompl/lattice_edges.h"

#include <ompl/base/ScopedState.h>
#include <ompl/base/spaces/DubinsStateSpace.h>
#include <ompl/base/spaces/ReedsSheppStateSpace.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/ompl/arrival.h"
#include "planner/ompl/path_cost.h"
#include "planner/ompl/steering_samplers.h"

namespace regoplan {
namespace {

namespace ob = ompl::base;

// Shares of the top speed. Downhill the vehicle is faster than its rims, so they stay below it.
constexpr double kFast = 0.93, kMedium = 0.6, kSlow = 0.3, kSlowest = 0.1;

double approached(double value, double target, double most) {
  return value + std::clamp(target - value, -most, most);
}

/// Where the speed stands after a distance under a constant target.
double speed_after_mps(const Vehicle& vehicle, double speed_mps, double target_mps,
                       double travel_m) {
  const double change = 2 * vehicle.acceleration_max_mps2 * travel_m;
  const double square = speed_mps * speed_mps;
  const double reached = target_mps > speed_mps ? std::sqrt(square + change)
                                                : std::sqrt(std::max(0.0, square - change));
  return target_mps > speed_mps ? std::min(reached, target_mps) : std::max(reached, target_mps);
}

/// Steps that a travel takes from one speed on the way to another, both of one direction.
int steps_of(const Vehicle& vehicle, double travel_m, double from_mps, double to_mps,
             double step_s) {
  constexpr int kFewest = 2, kMost = 80;
  const double end = speed_after_mps(vehicle, from_mps, to_mps, travel_m);
  const double changing_s = std::abs(end - from_mps) / vehicle.acceleration_max_mps2;
  const double rest_m = std::max(0.0, travel_m - (from_mps + end) / 2 * changing_s);
  const double duration_s = changing_s + rest_m / std::max(end, 1e-6);
  return std::clamp(static_cast<int>(std::lround(duration_s / step_s)), kFewest, kMost);
}

/// Length of the shortest slip-free way between two poses with the tightest turn of the vehicle.
double tightest_way_m(const PlanningProblem& problem, bool reverse, const VehicleState& from) {
  const double radius_m = 1 / problem.vehicle.curvature_max_1pm;
  const auto length = [&](const auto& space) {
    auto* a = space.allocState();
    auto* b = space.allocState();
    a->template as<ob::SE2StateSpace::StateType>()->setXY(from.x_m, from.y_m);
    a->template as<ob::SE2StateSpace::StateType>()->setYaw(from.yaw_rad);
    b->template as<ob::SE2StateSpace::StateType>()->setXY(problem.goal.x_m, problem.goal.y_m);
    b->template as<ob::SE2StateSpace::StateType>()->setYaw(*problem.goal.heading_rad);
    const double distance = space.distance(a, b);
    space.freeState(a);
    space.freeState(b);
    return distance;
  };
  return reverse ? length(ob::ReedsSheppStateSpace(radius_m))
                 : length(ob::DubinsStateSpace(radius_m));
}

/// How far beyond the goal the vehicle comes to the speed that is allowed there.
double overshoot_m(const PlanningProblem& problem, const VehicleState& state, double away_m) {
  const double braking_m =
      braking_distance_m(problem.vehicle, std::abs(state.motion.vx_mps),
                         std::min(problem.goal.speed_max_mps, problem.speed_max_mps));
  return std::max(0.0, braking_m - away_m - problem.goal.radius_m);
}

/// What gathering speed and braking for the goal take longer than driving at the wanted speed:
/// shorter of a speed by d, on the way to or from it, d^2/(2 speed acceleration).
double speed_changes_s(const PlanningProblem& problem, double now_mps, double wanted_mps,
                       double way_m) {
  const double a = problem.vehicle.acceleration_max_mps2;
  // On a short way the vehicle brakes before it is as fast as wanted.
  const double highest = std::sqrt(std::max(0.0, now_mps * now_mps / 2 + a * way_m));
  const double peak = std::max(std::min(wanted_mps, highest), 1e-6);
  const double from = std::max(0.0, peak - now_mps);
  const double to = std::max(0.0, peak - problem.goal.speed_max_mps);
  return (from * from + to * to) / (2 * peak * a) + way_m / peak - way_m / wanted_mps;
}

}  // namespace

std::vector<LatticeResolution> lattice_resolutions(const PlanningProblem& problem) {
  const double radius_m = 1 / problem.vehicle.curvature_max_1pm;
  // Drives three cells long: shorter ones end in the cell they began in, or where others did.
  std::vector<LatticeResolution> resolutions;
  for (const bool reverse : {false, true}) {
    double scale = 1;
    for (int level = 0; level < 3; ++level, scale /= 2) {
      resolutions.push_back({.cell_m = scale * radius_m / 2,
                             .headings = 24 << level,
                             .speeds = 4 << level,
                             .travel_m = scale * radius_m * 1.5,
                             .curvatures = 2 + level,
                             .reverse = reverse,
                             .speed_max_mps = problem.speed_max_mps});
    }
  }
  std::stable_sort(resolutions.begin(), resolutions.end(),
                   [](const auto& a, const auto& b) { return a.cell_m > b.cell_m; });
  return resolutions;
}

std::uint64_t lattice_cell(const LatticeResolution& resolution, const PlanningProblem& problem,
                           const VehicleState& state) {
  const GridFrame& frame = problem.map.elevation().frame;
  const auto part = [](double value) { return static_cast<std::uint64_t>(std::max(0.0, value)); };
  const double turn = state.yaw_rad / (2 * std::numbers::pi);
  const auto heading = part((turn - std::floor(turn)) * resolution.headings);
  const double speed = 1 + state.motion.vx_mps / resolution.speed_max_mps;  // in reverse too
  return part((state.x_m - frame.west_m) / resolution.cell_m) << 40 |
         part((state.y_m - frame.south_m()) / resolution.cell_m) << 16 | heading << 6 |
         part(speed * resolution.speeds);
}

std::vector<Drive> lattice_drives(const LatticeResolution& resolution, const OmplProblem& lattice,
                                  const VehicleState& from) {
  const World& world = lattice.world();
  const Vehicle& vehicle = world.problem().vehicle;
  const double step_s = lattice.step_s();
  const double speed_now = from.rim_speed_mps;
  std::vector<Drive> drives;
  const auto add = [&](double speed, double curvature, int steps) {
    drives.push_back({.control = {.speed_target_mps = speed, .curvature_target_1pm = curvature},
                      .steps = steps});
  };
  // To hold the speed takes no traction: a way on where the ground gives none to spare.
  const double held = std::min(speed_now / resolution.speed_max_mps, kFast);
  for (const double share : {kFast, kMedium, kSlow, held}) {
    if (share < kSlowest) continue;
    const double target = share * resolution.speed_max_mps;
    const double end =
        speed_after_mps(vehicle, std::max(0.0, speed_now), target, resolution.travel_m);
    const double reach = curvature_reach_1pm(world, from.x_m, from.y_m, std::max(speed_now, end));
    const int steps =
        steps_of(vehicle, resolution.travel_m, std::max(0.0, speed_now), target, step_s);
    for (int i = -resolution.curvatures; i <= resolution.curvatures; ++i) {
      add(target, reach * i / resolution.curvatures, steps);
    }
    if (speed_now < 0) continue;
    const double ahead_m = std::max(resolution.travel_m, 0.7 / reach);
    const CostToGo::Place place = lattice.way().ahead(from.x_m, from.y_m, ahead_m);
    add(target, pursuit_curvature_1pm(from, place.x_m, place.y_m, reach), steps);
  }
  if (!resolution.reverse || speed_now > kSlow * resolution.speed_max_mps) return drives;
  const double target = -kSlow * resolution.speed_max_mps;
  const double reach = curvature_reach_1pm(world, from.x_m, from.y_m, target);
  const int steps =
      steps_of(vehicle, resolution.travel_m, std::max(0.0, -speed_now), -target, step_s);
  for (int i = -resolution.curvatures; i <= resolution.curvatures; ++i) {
    add(target, reach * i / resolution.curvatures, steps);
  }
  return drives;
}

VehicleState rough_end(const Vehicle& vehicle, const VehicleState& from, const Drive& drive,
                       double step_s) {
  constexpr int kParts = 4;
  const double part_s = drive.steps * step_s / kParts;
  VehicleState state = from;
  for (int i = 0; i < kParts; ++i) {
    const double speed = state.rim_speed_mps, curvature = state.curvature_1pm;
    state.rim_speed_mps =
        approached(speed, drive.control.speed_target_mps, vehicle.acceleration_max_mps2 * part_s);
    state.curvature_1pm = approached(curvature, drive.control.curvature_target_1pm,
                                     vehicle.curvature_rate_max_1pms * part_s);
    const double travel = (speed + state.rim_speed_mps) / 2 * part_s;
    const double turn = travel * (curvature + state.curvature_1pm) / 2;
    state.x_m += travel * std::cos(state.yaw_rad + turn / 2);
    state.y_m += travel * std::sin(state.yaw_rad + turn / 2);
    state.yaw_rad += turn;
  }
  state.motion.vx_mps = state.rim_speed_mps;
  return state;
}

double rough_cost_to_go(const LatticeResolution& resolution, const OmplProblem& lattice,
                        const VehicleState& state) {
  const PlanningProblem& problem = lattice.world().problem();
  double way_m = lattice.way().cost_m(state.x_m, state.y_m);
  if (!std::isfinite(way_m)) return way_m;
  const double radius_m = 1 / problem.vehicle.curvature_max_1pm;
  const double away_m = std::hypot(state.x_m - problem.goal.x_m, state.y_m - problem.goal.y_m);
  // Turns are driven at the speed that turns fastest; what they add counts at that speed.
  const double top = kFast * resolution.speed_max_mps;
  const double turning = std::clamp(fastest_turning_mps(lattice.world(), state.x_m, state.y_m),
                                    kSlow * resolution.speed_max_mps, top);
  double excess_m = 0;
  if (problem.goal.heading_rad) {
    const double around_m = tightest_way_m(problem, resolution.reverse, state);
    excess_m = std::max(0.0, around_m - away_m - problem.goal.radius_m);
  } else if (away_m > problem.goal.radius_m) {
    // An arc that turns by an angle is longer than the progress it makes that way.
    const CostToGo::Place place = lattice.way().ahead(state.x_m, state.y_m, 2 * radius_m);
    const double toward_rad = std::atan2(place.y_m - state.y_m, place.x_m - state.x_m);
    const double turn = std::abs(std::remainder(toward_rad - state.yaw_rad, 2 * std::numbers::pi));
    excess_m = (turn - std::sin(turn)) * radius_m;
    if (resolution.reverse) excess_m = std::min(excess_m, 3 * radius_m);
  }
  way_m += excess_m * top / turning;
  const double wanted = excess_m > radius_m ? turning : top;
  const double too_fast_m = overshoot_m(problem, state, away_m);
  way_m += 2 * too_fast_m * top / turning;  // and back
  return rough_cost(problem, way_m, way_m / resolution.speed_max_mps) +
         problem.search.objective.per_s *
             speed_changes_s(problem, state.motion.vx_mps, std::min(wanted, top), way_m);
}

}  // namespace regoplan
