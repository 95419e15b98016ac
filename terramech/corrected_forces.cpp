#include "terramech/corrected_forces.h"

#include <cmath>
#include <optional>

#include "terramech/forward_motion.h"

namespace regoplan {
namespace {

bool may_be_corrected(WheelStatus status) {
  return status == WheelStatus::kOk || status == WheelStatus::kUntrusted;
}

WheelStatus outside(WheelStatus status) {
  return status == WheelStatus::kOk ? WheelStatus::kOutsideCorrection : status;
}

CorrectionPoint point_at(double load_n, const ForwardMotion& forward) {
  return {.slip_ratio = forward.ratios.slip,
          .slip_angle_rad = forward.ratios.beta_abs_rad,
          .load_n = load_n};
}

}  // namespace

WheelForces corrected(const GenericCorrection& correction, double load_n, const WheelMotion& motion,
                      WheelForces forces) {
  if (!may_be_corrected(forces.status)) return forces;
  const ForwardMotion forward = forward_motion(motion);
  const CorrectionPoint point = point_at(load_n, forward);
  if (!is_inside(correction, point)) {
    forces.status = outside(forces.status);
    return forces;
  }
  const CorrectionValue added = correction_at(correction, point).value;
  forces.fx_n += forward.x_sign * added.fx_n;
  forces.fy_n += forward.y_sign * added.fy_n;
  forces.torque_nm += forward.x_sign * added.torque_nm;
  forces.sinkage_m += added.sinkage_m;
  return forces;
}

SlopedForces corrected(const GenericCorrection& correction, double load_n,
                       const WheelMotion& motion, SlopedForces forces) {
  if (!may_be_corrected(forces.status)) return forces;
  const ForwardMotion forward = forward_motion(motion);
  const CorrectionPoint point = point_at(load_n, forward);
  if (!is_inside(correction, point)) {
    forces.status = outside(forces.status);
    return forces;
  }
  const SlopedCorrection added = correction_at(correction, point);
  const double sx = forward.x_sign, sy = forward.y_sign;
  // of slip ratio and |slip angle| over the rim speed a, |Vx| and |Vy|
  const double a = std::abs(motion.rim_speed_mps), b = std::abs(motion.vx_mps);
  const double c = std::abs(motion.vy_mps), v2 = b * b + c * c;
  const double slip_by_a = a >= b ? b / (a * a) : 1 / b;
  const double slip_by_b = a >= b ? -1 / a : -a / (b * b);
  const double angle_by_b = v2 > 0 ? -c / v2 : 0, angle_by_c = v2 > 0 ? b / v2 : 0;
  const auto add = [&](SlopedForce& force, double CorrectionValue::*channel, double own_sign,
                       double by_vy_sign) {
    const double by_slip = added.by_slip_ratio.*channel, by_angle = added.by_slip_angle.*channel;
    force.value_n += own_sign * added.value.*channel;
    force.by_load += own_sign * added.by_log_load.*channel / load_n;
    force.by_vx_nspm += own_sign * sx * (by_slip * slip_by_b + by_angle * angle_by_b);
    force.by_vy_nspm += by_vy_sign * by_angle * angle_by_c;
    force.by_rim_speed_nspm += own_sign * sx * by_slip * slip_by_a;
  };
  add(forces.fx, &CorrectionValue::fx_n, sx, sx * sy);
  add(forces.fy, &CorrectionValue::fy_n, sy, 1);  // also at slip angle 0, where it rises through 0
  forces.torque_nm += sx * added.value.torque_nm;
  return forces;
}

}  // namespace regoplan
