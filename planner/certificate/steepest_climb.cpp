#include "planner/certificate/steepest_climb.h"

#include <cmath>

namespace regoplan {

std::vector<std::optional<double>> steepest_climbs_rad(const World& world) {
  const PlanningProblem& problem = world.problem();
  constexpr double kSlowShare = 0.3;  // of the top speed
  const VehicleState state =
      world.dynamics().rolling_state(0, 0, 0, kSlowShare * problem.speed_max_mps);
  std::vector<std::optional<double>> steepest;
  for (std::size_t soil = 0; soil < problem.map.soils().size(); ++soil) {
    const auto climbs = [&](double slope_rad) {
      GroundPatch patch{.known = true, .slope_forward = std::tan(slope_rad)};
      patch.soil.fill(static_cast<std::int16_t>(soil));
      const std::optional<double> margin = world.margins(state, patch).stability();
      return margin && *margin >= problem.limits.margin_min;
    };
    if (!climbs(0)) {
      steepest.emplace_back();
      continue;
    }
    double climbed = 0;
    for (double step = problem.limits.slope_max_rad; step > problem.limits.slope_max_rad / 32;
         step /= 2) {
      if (climbed + step <= problem.limits.slope_max_rad && climbs(climbed + step)) climbed += step;
    }
    steepest.emplace_back(climbed);
  }
  return steepest;
}

}  // namespace regoplan
