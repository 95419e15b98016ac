#include "planner/ompl/path_cost.h"

#include <algorithm>
#include <cmath>

namespace regoplan {

double step_cost(const World& world, const VehicleSpace::Values& from, const SearchStep& step,
                 double duration_s) {
  const Objective& objective = world.problem().search.objective;
  const VehicleState& a = from.vehicle;
  const VehicleState& b = step.values.vehicle;
  double cost = objective.per_s * duration_s +
                objective.per_m * std::hypot(b.x_m - a.x_m, b.y_m - a.y_m) +
                objective.per_j * std::max(0.0, step.drive_energy_j);
  if (objective.per_exposed_s > 0) {
    const GroundPatch patch = world.dynamics().ground(b.x_m, b.y_m, b.yaw_rad);
    const double margin = patch.known ? world.margins(b, patch).stability().value_or(-1) : -1;
    const double shortage = 1 - margin / objective.exposed_below;
    cost += objective.per_exposed_s * duration_s * std::max(0.0, shortage);
  }
  return cost;
}

double rough_cost(const PlanningProblem& problem, double length_m, double duration_s) {
  constexpr double kRolling = 0.1;
  const Objective& objective = problem.search.objective;
  const double rolling_n = kRolling * problem.vehicle.mass_kg * problem.gravity_mps2;
  return objective.per_s * duration_s + (objective.per_m + objective.per_j * rolling_n) * length_m;
}

double least_cost(const PlanningProblem& problem, double length_m) {
  const Objective& objective = problem.search.objective;
  return std::max(0.0, length_m) * (objective.per_s / problem.speed_max_mps + objective.per_m);
}

}  // namespace regoplan
