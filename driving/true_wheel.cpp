#include "driving/true_wheel.h"

#include <cmath>
#include <utility>

namespace regoplan {
namespace {

WheelModelSpec with_true_radius(WheelModelSpec spec, double factor) {
  spec.wheel.radius_m *= factor;
  return spec;
}

}  // namespace

TrueWheel::TrueWheel(WheelModelSpec spec, const WheelFault& fault, int pass)
    : fault_(fault),
      model_(with_true_radius(std::move(spec), fault.radius_factor)),
      conditions_{.pass = pass},
      plain_(model_.spec().mechanisms.empty()),
      cos_offset_(std::cos(fault.steer_offset_rad)),
      sin_offset_(std::sin(fault.steer_offset_rad)) {}

WheelMotion TrueWheel::true_motion(const WheelMotion& commanded) const {
  return {.vx_mps = cos_offset_ * commanded.vx_mps + sin_offset_ * commanded.vy_mps,
          .vy_mps = cos_offset_ * commanded.vy_mps - sin_offset_ * commanded.vx_mps,
          .rim_speed_mps = fault_.radius_factor * commanded.rim_speed_mps};
}

WheelForces TrueWheel::forces(double load_n, const WheelMotion& commanded) const {
  const WheelMotion motion = true_motion(commanded);
  WheelForces forces =
      plain_ ? model_.forces(load_n, motion) : model_.channels(load_n, motion, conditions_).forces;
  // The force on the wheel is (fx, -fy) in its own frame.
  const double fx = forces.fx_n, fy = forces.fy_n;
  forces.fx_n = cos_offset_ * fx + sin_offset_ * fy;
  forces.fy_n = cos_offset_ * fy - sin_offset_ * fx;
  if (fault_.drag_nm != 0 && motion.rim_speed_mps != 0) {
    forces.torque_nm += std::copysign(fault_.drag_nm, motion.rim_speed_mps);
  }
  return forces;
}

}  // namespace regoplan
