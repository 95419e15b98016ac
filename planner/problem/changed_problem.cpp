#include "planner/problem/changed_problem.h"

#include <utility>

namespace regoplan {

PlanningProblem with_soils(PlanningProblem problem, std::vector<MapSoil> soils) {
  problem.map = problem.map.with_soils(std::move(soils));
  return problem;
}

PlanningProblem with_soils_forbidden(PlanningProblem problem,
                                     const std::vector<std::string>& soils) {
  problem.map = problem.map.forbidding(soils);
  return problem;
}

PlanningProblem with_speed_max(PlanningProblem problem, double speed_max_mps) {
  problem.speed_max_mps = speed_max_mps;
  return problem;
}

PlanningProblem with_goal_radius(PlanningProblem problem, double radius_m) {
  problem.goal.radius_m = radius_m;
  return problem;
}

PlanningProblem with_limits(PlanningProblem problem, const Limits& limits) {
  problem.limits = limits;
  return problem;
}

}  // namespace regoplan
