#include "planner/ompl/lattice.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "planner/driving/steer_back.h"
#include "planner/ompl/goal_connection.h"
#include "planner/ompl/path_cost.h"
#include "planner/ompl/path_improvement.h"
#include "planner/ompl/steering_samplers.h"

namespace regoplan {

namespace ob = ompl::base;

Lattice::Lattice(OmplProblem& problem)
    : ob::Planner(problem.space(), "Lattice"), problem_(problem) {
  specs_.optimizingPaths = true;
  specs_.directed = true;
  addPlannerProgressProperty("best cost REAL", [this] { return std::to_string(best_.cost()); });
}

void Lattice::clear() {
  Planner::clear();
  starts_.clear();
  bound_ = kNoBound;
  found_.clear();
  best_.clear();
}

void Lattice::push(Round& round, double cost, const VehicleState& state, int node,
                   const std::optional<Drive>& drive) {
  const double rest = rough_cost_to_go(round.resolution, problem_, state);
  if (!std::isfinite(rest)) return;
  if (!drive) round.nearest = std::min(round.nearest, rest);
  round.open.push({.priority = cost + round.weight * rest,
                   .order = round.pushed++,
                   .node = node,
                   .drive = drive,
                   .cost = cost,
                   .cell = lattice_cell(round.resolution, problem_.world().problem(), state)});
}

bool Lattice::covered(const Round& round, std::uint64_t cell, double cost) {
  const auto known = round.cells.find(cell);
  return known != round.cells.end() && (known->second.closed || known->second.cost <= cost);
}

void Lattice::expand(Round& round, int index) {
  const DriveNode node = round.nodes[static_cast<std::size_t>(index)];
  const VehicleState& from = node.values.vehicle;
  const PlanningProblem& problem = problem_.world().problem();
  const double step_s = problem_.step_s();
  for (const Drive& drive : lattice_drives(round.resolution, problem_, from)) {
    const VehicleState end = rough_end(problem.vehicle, from, drive, step_s);
    const double duration_s = drive.steps * step_s;
    const double length_m = duration_s * std::abs(from.rim_speed_mps + end.rim_speed_mps) / 2;
    const double cost = node.cost + rough_cost(problem, length_m, duration_s);
    push(round, cost, end, index, drive);
  }
}

bool Lattice::connect(Round& round, int index) {
  const World& world = problem_.world();
  const PlanningProblem& asked = world.problem();
  const DriveNode& from = round.nodes[static_cast<std::size_t>(index)];
  const VehicleState& state = from.values.vehicle;
  constexpr double kSlowShare = 0.35, kRadii = 12, kEvery_radii = 2;
  const double radius_m = 1 / asked.vehicle.curvature_max_1pm;
  const double away_radii =
      std::hypot(state.x_m - asked.goal.x_m, state.y_m - asked.goal.y_m) / radius_m;
  if (!asked.goal.heading_rad || std::abs(state.rim_speed_mps) > kSlowShare * asked.speed_max_mps ||
      away_radii > kRadii) {
    return false;
  }
  // The nearer, the oftener.
  if (round.near_goal++ % (1 + static_cast<int>(away_radii / kEvery_radii)) != 0) return false;
  const GoalConnection way = connection_to_goal(problem_, state, 2 * kRadii * radius_m);
  VehicleSpace::Values values = from.values;
  double cost = from.cost;
  std::vector<Drive> drives = drives_to(round.nodes, index);
  for (const GoalConnection::Step& due : way.steps) {
    const VehicleControl control = steered_back(asked, due.control, due.due, values.vehicle);
    const SearchStep step = problem_.steps().next(values, control, problem_.step_s());
    cost += step_cost(world, values, step, problem_.step_s());
    values = step.values;
    drives.push_back({.control = control, .steps = 1});
    if (hopeless(cost, values.vehicle) || !problem_.steps().allowed(values)) {
      return false;
    }
    if (world.at_goal(values.vehicle) && !refused_stop(problem_.steps(), values)) {
      return arrive(cost, std::move(drives));
    }
  }
  return false;
}

bool Lattice::arrive_from(const Round& round, int index) {
  const DriveNode& node = round.nodes[static_cast<std::size_t>(index)];
  const Arrival arrival = problem_.arrival(node.values, node.cost, bound_);
  if (!arrival.reached) return false;
  std::vector<Drive> drives = drives_to(round.nodes, index);
  const std::vector<Drive> end = drives_of(arrival.controls, problem_.step_s());
  drives.insert(drives.end(), end.begin(), end.end());
  return arrive(node.cost + arrival.cost, std::move(drives));
}

bool Lattice::try_drive(Round& round, int parent, const Drive& drive) {
  const World& world = problem_.world();
  const double step_s = problem_.step_s();
  DriveNode node{.values = round.nodes[static_cast<std::size_t>(parent)].values,
                 .cost = round.nodes[static_cast<std::size_t>(parent)].cost,
                 .parent = parent,
                 .drive = {.control = drive.control}};
  while (node.drive.steps < drive.steps) {
    const SearchStep step = problem_.steps().next(node.values, drive.control, step_s);
    node.cost += step_cost(world, node.values, step, step_s);
    node.values = step.values;
    ++node.drive.steps;
    if (!problem_.steps().allowed(node.values)) return false;
    if (!world.at_goal(node.values.vehicle)) continue;
    round.nodes.push_back(node);
    return arrive_from(round, static_cast<int>(round.nodes.size()) - 1);
  }
  Cell& cell =
      round.cells
          .try_emplace(lattice_cell(round.resolution, world.problem(), node.values.vehicle),
                       Cell{.cost = std::numeric_limits<double>::infinity()})
          .first->second;
  if (cell.closed || node.cost >= cell.cost || hopeless(node.cost, node.values.vehicle)) {
    return false;
  }
  cell.cost = node.cost;
  round.nodes.push_back(node);
  const int index = static_cast<int>(round.nodes.size()) - 1;
  if (arrive_from(round, index)) return true;
  push(round, node.cost, node.values.vehicle, index, std::nullopt);
  return false;
}

Lattice::RoundEnd Lattice::search(Round& round, int drives,
                                  const ob::PlannerTerminationCondition& stop) {
  if (round.nodes.empty()) {
    for (const VehicleSpace::Values& start : starts_) {
      round.nodes.push_back({.values = start});
      const int index = static_cast<int>(round.nodes.size()) - 1;
      if (arrive_from(round, index)) return RoundEnd::kFound;
      push(round, 0, start.vehicle, index, std::nullopt);
    }
  }
  while (!round.open.empty()) {
    const Entry entry = round.open.top();
    if (entry.drive && drives == 0) return RoundEnd::kBoundReached;
    round.open.pop();
    const DriveNode& node = round.nodes[static_cast<std::size_t>(entry.node)];
    if (hopeless(node.cost, node.values.vehicle)) continue;
    if (!entry.drive) {
      Cell& cell = round.cells[lattice_cell(round.resolution, problem_.world().problem(),
                                            node.values.vehicle)];
      if (cell.closed) continue;
      cell.closed = true;
      if (round.resolution.reverse && connect(round, entry.node)) return RoundEnd::kFound;
      expand(round, entry.node);
      continue;
    }
    if (covered(round, entry.cell, entry.cost)) continue;
    if (stop) return RoundEnd::kStopped;
    --drives;
    if (try_drive(round, entry.node, *entry.drive)) return RoundEnd::kFound;
  }
  return RoundEnd::kExhausted;
}

void Lattice::search_for_first(const ob::PlannerTerminationCondition& stop) {
  const PlanningProblem& asked = problem_.world().problem();
  const std::vector<LatticeResolution> resolutions = lattice_resolutions(asked);
  // A careful look first; where that does not lead there soon, slower ones, as long as the vehicle
  // may go much faster than where it turns fastest, and greedier ones.
  constexpr double kCareful = 2.5, kGreedy = 4, kMuchFaster = 1.5;
  std::vector<Round> rounds;
  const double turning_mps =
      fastest_turning_mps(problem_.world(), asked.start.x_m, asked.start.y_m);
  double top_mps = asked.speed_max_mps;
  do {
    rounds.push_back({.resolution = resolutions.front(), .weight = kCareful});
    rounds.back().resolution.speed_max_mps = top_mps;
    top_mps /= 2;
  } while (top_mps > kMuchFaster * turning_mps);
  for (const LatticeResolution& resolution : resolutions) {
    rounds.push_back({.resolution = resolution, .weight = kGreedy});
  }
  constexpr int kFirstTurn = 2000, kLongestTurn = 1 << 28;
  constexpr double kNearer = 0.95;
  for (int turn = kFirstTurn; turn < kLongestTurn && !rounds.empty(); turn *= 2) {
    for (auto round = rounds.begin(); round != rounds.end();) {
      // Reverse seldom helps where no heading is asked for, and looks at the same ground again.
      const bool seldom = round->resolution.reverse && !asked.goal.heading_rad;
      const int drives = seldom ? turn / 4 : turn;
      RoundEnd end = RoundEnd::kBoundReached;
      double before = kNoBound;
      do {  // who comes nearer goes on
        before = round->nearest;
        end = search(*round, drives, stop);
      } while (end == RoundEnd::kBoundReached && round->nearest < kNearer * before);
      if (end == RoundEnd::kFound || end == RoundEnd::kStopped) return;
      round = end == RoundEnd::kExhausted ? rounds.erase(round) : round + 1;
    }
  }
}

bool Lattice::arrive(double cost, std::vector<Drive> drives) {
  if (!(cost < bound_)) return false;
  bound_ = cost;
  found_ = drives;
  if (best_.offer(cost, std::move(drives))) announce(*this, problem_, starts_.front(), best_);
  return true;
}

void Lattice::optimise() {
  const double step_s = problem_.step_s();
  const auto path = improved(problem_.steps(), controls_of(found_, step_s));
  if (path && best_.offer(path->improvement.cost_after, drives_of(path->controls, step_s))) {
    announce(*this, problem_, starts_.front(), best_);
  }
}

void Lattice::improve(const ob::PlannerTerminationCondition& stop) {
  std::vector<Round> rounds;
  // Driving in reverse is slow: it saves nothing but where there is no other way.
  const bool reverses = std::any_of(found_.begin(), found_.end(), [](const Drive& drive) {
    return drive.control.speed_target_mps < 0;
  });
  for (const LatticeResolution& resolution : lattice_resolutions(problem_.world().problem())) {
    if (resolution.reverse && !reverses) continue;
    for (const double weight : {1.8, 1.3, 1.0}) {
      rounds.push_back({.resolution = resolution, .weight = weight});
    }
  }
  constexpr int kFirstTurn = 4000, kLongestTurn = 1 << 28;
  for (int turn = kFirstTurn; turn < kLongestTurn && !rounds.empty(); turn *= 2) {
    for (auto round = rounds.begin(); round != rounds.end();) {
      const RoundEnd end = search(*round, turn, stop);
      if (end == RoundEnd::kStopped) return;
      if (end == RoundEnd::kFound) {
        optimise();
        // From the start again: what led here is closed.
        *round = {.resolution = round->resolution, .weight = round->weight};
      } else {
        round = end == RoundEnd::kExhausted ? rounds.erase(round) : round + 1;
      }
    }
  }
}

ob::PlannerStatus Lattice::solve(const ob::PlannerTerminationCondition& stop) {
  checkValidity();
  while (const ob::State* start = pis_.nextStart()) {
    starts_.push_back(*start->as<VehicleSpace::StateType>());
  }
  if (starts_.empty()) return ob::PlannerStatus::INVALID_START;
  if (!best_.found()) {
    search_for_first(stop);
    if (!best_.found()) return ob::PlannerStatus::TIMEOUT;
    if (problem_.improves()) optimise();
  }
  if (problem_.improves()) improve(stop);
  enter_solution(*this, problem_, starts_.front(), best_);
  return ob::PlannerStatus::EXACT_SOLUTION;
}

}  // namespace regoplan
