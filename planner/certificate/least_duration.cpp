#include "planner/certificate/least_duration.h"

#include <algorithm>
#include <cmath>

#include "planner/certificate/least_length.h"
#include "terramech/vehicle/vehicle_dynamics.h"

namespace regoplan {

double FastestDrive::duration_s(double length_m) const {
  if (!std::isfinite(length_m)) return length_m;
  const double a = acceleration_mps2;
  const double start = std::min(start_mps, speed_max_mps), end = std::min(end_mps, speed_max_mps);
  // Speeding up to the peak takes (peak^2 - start^2) / 2a of the way, slowing down likewise.
  const double peak_squared = a * length_m + (start * start + end * end) / 2;
  const double peak = std::min(speed_max_mps, std::sqrt(peak_squared));
  const auto way_m = [&](double from) {
    return std::max(0.0, peak * peak - from * from) / (2 * a);
  };
  const auto time_s = [&](double from) { return std::max(0.0, peak - from) / a; };
  const double cruise_m = std::max(0.0, length_m - way_m(start) - way_m(end));
  return time_s(start) + time_s(end) + cruise_m / peak;
}

double least_duration_s(const PlanningProblem& problem) {
  constexpr double kHeldWithin = 1.001;
  const double per_rim_speed = 1 / (1 - std::min(problem.limits.slip_max, 0.999));
  const double top = kHeldWithin * problem.speed_max_mps;
  const FastestDrive drive{
      .speed_max_mps = top,
      .acceleration_mps2 = per_rim_speed * problem.vehicle.acceleration_max_mps2,
      .start_mps = per_rim_speed * problem.start.speed_mps,
      .end_mps = per_rim_speed *
                 std::max(problem.goal.speed_max_mps, VehicleDynamics::kStandstillSpeed_mps)};
  return drive.duration_s(LeastLength(problem).to_goal_m(problem.start.x_m, problem.start.y_m));
}

}  // namespace regoplan
