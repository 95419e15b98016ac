#include "planner/ompl/stable_sparse.h"

#include <cmath>
#include <numbers>
#include <string>

#include "planner/ompl/path_cost.h"
#include "planner/ompl/steering_samplers.h"

namespace regoplan {

namespace ob = ompl::base;

StableSparse::StableSparse(OmplProblem& problem)
    : ob::Planner(problem.space(), "StableSparse"),
      problem_(problem),
      tree_(problem.world().problem()),
      random_(problem.seed()) {
  specs_.optimizingPaths = true;
  specs_.directed = true;
  addPlannerProgressProperty("best cost REAL", [this] { return std::to_string(best_.cost()); });
  addPlannerProgressProperty("nodes INTEGER", [this] { return std::to_string(tree_.active()); });
  addPlannerProgressProperty("inactive nodes INTEGER",
                             [this] { return std::to_string(tree_.inactive()); });
  addPlannerProgressProperty("witnesses INTEGER",
                             [this] { return std::to_string(tree_.witnesses()); });
}

void StableSparse::clear() {
  Planner::clear();
  tree_.clear();
  best_.clear();
  random_.setLocalSeed(problem_.seed());
}

bool StableSparse::hopeless(double cost, const VehicleState& state) const {
  return problem_.hopeless(cost, state, best_.cost());
}

VehicleState StableSparse::drawn_state() {
  const PlanningProblem& problem = problem_.world().problem();
  const GridFrame& frame = problem.map.elevation().frame;
  constexpr int kTries = 100;
  VehicleState state;
  for (int i = 0; i < kTries; ++i) {
    state.x_m = random_.uniformReal(frame.west_m, frame.east_m());
    state.y_m = random_.uniformReal(frame.south_m(), frame.north_m);
    const double from_start_m =
        std::hypot(state.x_m - start_.vehicle.x_m, state.y_m - start_.vehicle.y_m);
    if (!hopeless(least_cost(problem, from_start_m), state)) break;
  }
  state.yaw_rad = random_.uniformReal(-std::numbers::pi, std::numbers::pi);
  state.motion.vx_mps = random_.uniformReal(0.5, 1) * problem.speed_max_mps;
  return state;
}

Drive StableSparse::drawn_drive(const VehicleState& from, const VehicleState& toward) {
  constexpr double kGuided = 0.5, kToward = 0.2;
  constexpr int kShortest = 4, kLongest = 24;
  const PlanningProblem& problem = problem_.world().problem();
  Drive drive{.steps = random_.uniformInt(kShortest, kLongest)};
  const double choice = random_.uniform01();
  constexpr double kReverse = 0.05, kReverseSpeedShare = 0.3;
  const double reverse_mps = kReverseSpeedShare * problem.speed_max_mps;
  if (choice >= 1 - kReverse && from.rim_speed_mps < reverse_mps) {
    const double reach = curvature_reach_1pm(problem_.world(), from.x_m, from.y_m, reverse_mps);
    drive.control = {.speed_target_mps = -reverse_mps,
                     .curvature_target_1pm = random_.uniformReal(-reach, reach)};
    return drive;
  }
  const double speed = drawn_speed_mps(problem, random_);
  if (choice < kGuided) {
    const CostToGo::Place place = aim(problem_.world(), problem_.way(), from, speed, random_);
    drive.control = control_toward(problem_.world(), from, place.x_m, place.y_m, speed);
  } else if (choice < kGuided + kToward) {
    drive.control = control_toward(problem_.world(), from, toward.x_m, toward.y_m, speed);
  } else {
    drive.control = drawn_control(problem_.world(), from, random_);
  }
  return drive;
}

bool StableSparse::arrive_from(const DriveNode& node) {
  const Arrival arrival = problem_.arrival(node.values, node.cost, best_.cost());
  if (!arrival.reached) return false;
  std::vector<Drive> drives = drives_to(tree_.nodes(), node.parent);
  drives.push_back(node.drive);
  const std::vector<Drive> end = drives_of(arrival.controls, problem_.step_s());
  drives.insert(drives.end(), end.begin(), end.end());
  return best_.offer(node.cost + arrival.cost, std::move(drives));
}

bool StableSparse::extend(int parent, const Drive& drive) {
  const World& world = problem_.world();
  const DriveNode& from = tree_.nodes()[static_cast<std::size_t>(parent)];
  DriveNode node{.values = from.values,
                 .cost = from.cost,
                 .parent = parent,
                 .drive = {.control = drive.control}};
  while (node.drive.steps < drive.steps) {
    const SearchStep step = problem_.steps().next(node.values, drive.control, problem_.step_s());
    node.cost += step_cost(world, node.values, step, problem_.step_s());
    node.values = step.values;
    ++node.drive.steps;
    if (hopeless(node.cost, node.values.vehicle) || !problem_.steps().allowed(node.values)) {
      return false;
    }
    if (world.at_goal(node.values.vehicle)) return arrive_from(node);
  }
  if (!tree_.welcome(node.values.vehicle, node.cost)) return false;
  tree_.grow(node);
  return arrive_from(node);
}

ob::PlannerStatus StableSparse::solve(const ob::PlannerTerminationCondition& stop) {
  checkValidity();
  while (const ob::State* start = pis_.nextStart()) {
    start_ = *start->as<VehicleSpace::StateType>();
    tree_.plant(start_);
  }
  if (tree_.empty()) return ob::PlannerStatus::INVALID_START;
  while (!stop && (problem_.improves() || !best_.found())) {
    const VehicleState toward = drawn_state();
    const int node = tree_.select(toward);
    const VehicleState from = tree_.nodes()[static_cast<std::size_t>(node)].values.vehicle;
    if (!extend(node, drawn_drive(from, toward))) continue;
    tree_.prune([this](double cost, const VehicleState& state) { return hopeless(cost, state); });
    announce(*this, problem_, start_, best_);
  }
  if (!best_.found()) return ob::PlannerStatus::TIMEOUT;
  enter_solution(*this, problem_, start_, best_);
  return ob::PlannerStatus::EXACT_SOLUTION;
}

}  // namespace regoplan
