#include "terramech/steered_wheel.h"

#include <cmath>

namespace regoplan {

SteeredWheel steered_wheel(const Vehicle& vehicle, const WheelMount& mount, double curvature_1pm) {
  const double steer = steer_angle_rad(vehicle, mount, curvature_1pm);
  const double c = std::cos(steer), s = std::sin(steer);
  const double slip_free = kinematic_body_slip_angle_rad(vehicle, curvature_1pm);
  const double vx = std::cos(slip_free) - curvature_1pm * mount.y_m;
  const double vy = std::sin(slip_free) + curvature_1pm * mount.x_m;
  return {
      .steer_rad = steer, .cos_steer = c, .sin_steer = s, .rim_speed_per_speed = c * vx + s * vy};
}

}  // namespace regoplan
