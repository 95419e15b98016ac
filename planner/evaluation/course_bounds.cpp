#include "planner/evaluation/course_bounds.h"

#include <cmath>

namespace regoplan {

double drive_steps(const ReferencePath& path) {
  return path.duration_s() / tracking_step_s(path.speed_max_mps());
}

double drive_steps(const SpotTurn& turn, const Vehicle& vehicle) {
  return std::abs(turn.angle_rad) / turn.rate_rad_s / turning_step_s(turn.rate_rad_s, vehicle);
}

double drive_time_max_s(double speed_max_mps) {
  return kDriveStepsMax * tracking_step_s(speed_max_mps);
}

}  // namespace regoplan
