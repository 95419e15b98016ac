#include "planner/driving/wheel_loads_along.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "maps/ground_finder.h"
#include "terramech/margins/state_margins.h"
#include "terramech/vehicle/vehicle_dynamics.h"
#include "terramech/wheel/wheel_model.h"

namespace regoplan {
namespace {

/// What the ground carries at a point, in the vehicle's axes.
GroundReaction reaction_at(const VehicleDynamics& dynamics, const TrajectoryPoint& point,
                           const GroundPatch& patch) {
  VehicleState state = dynamics.rolling_state(point.x_m, point.y_m, point.yaw_rad, point.speed_mps,
                                              point.curvature_1pm);
  state.rim_acceleration_mps2 = point.acceleration_mps2;
  const SupplyQuestion question = question_of(dynamics, state, patch);
  const bool supplied = point.supply_min_n <= point.supply_max_n;
  const double left_n =
      supplied ? std::clamp(question.force.left_n, point.supply_min_n, point.supply_max_n)
               : question.force.left_n;
  const double slip_free =
      kinematic_body_slip_angle_rad(dynamics.vehicle(), question.curvature_1pm);
  const double c = std::cos(slip_free), s = std::sin(slip_free);
  return {.normal_n = question.normal_n,
          .forward_n = c * question.force.forward_n - s * left_n,
          .left_n = s * question.force.forward_n + c * left_n};
}

}  // namespace

std::vector<std::vector<double>> wheel_loads_along_n(const PlanningProblem& problem,
                                                     std::span<const TrajectoryPoint> points) {
  const GroundFinder ground(problem.map, problem.vehicle);
  // Loads do not hang on the soil: that of any will do.
  const WheelModel any(wheel_model_spec(problem, problem.map.soils().front().soil.mean));
  const std::vector<WheelLaw> laws{WheelLaw(any)};
  const VehicleDynamics dynamics(
      problem.vehicle, laws,
      [&](double x_m, double y_m, double yaw_rad) { return ground.at(x_m, y_m, yaw_rad); },
      problem.gravity_mps2);
  std::vector<std::vector<double>> loads;
  for (const TrajectoryPoint& point : points) {
    const GroundPatch patch = dynamics.ground(point.x_m, point.y_m, point.yaw_rad);
    if (patch.known) {
      loads.push_back(dynamics.sharing().loads_n(reaction_at(dynamics, point, patch)));
    } else {
      loads.emplace_back(problem.vehicle.wheels.size(), std::numeric_limits<double>::quiet_NaN());
    }
  }
  return loads;
}

}  // namespace regoplan
