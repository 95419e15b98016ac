#include "terramech/wheel/corrected_forces.h"

#include <cmath>

#include "terramech/wheel/forward_motion.h"

namespace regoplan {
namespace {

bool may_be_corrected(WheelStatus status) {
  return status == WheelStatus::kOk || status == WheelStatus::kUntrusted;
}

WheelStatus outside(WheelStatus status) {
  return status == WheelStatus::kOk ? WheelStatus::kOutsideCorrection : status;
}

/// What `add` makes of the forces where the correction was learned.
/// \param add (forces, forward motion, point of the correction) to forces
template <class Forces, class Add>
Forces where_learned(const GenericCorrection& correction, double load_n, const WheelMotion& motion,
                     Forces forces, const Add& add) {
  if (!may_be_corrected(forces.status)) return forces;
  const ForwardMotion forward = forward_motion(motion);
  const CorrectionPoint point{.slip_ratio = forward.ratios.slip,
                              .slip_angle_rad = forward.ratios.beta_abs_rad,
                              .load_n = load_n};
  if (is_inside(correction, point)) return add(forces, forward, point);
  forces.status = outside(forces.status);
  return forces;
}

}  // namespace

WheelForces corrected(const GenericCorrection& correction, double load_n, const WheelMotion& motion,
                      WheelForces forces) {
  const auto add = [&](WheelForces sum, const ForwardMotion& forward,
                       const CorrectionPoint& point) {
    const CorrectionValue added = correction_at(correction, point).value;
    sum.fx_n += forward.x_sign * added.fx_n;
    sum.fy_n += forward.y_sign * added.fy_n;
    sum.torque_nm += forward.x_sign * added.torque_nm;
    sum.sinkage_m += added.sinkage_m;
    return sum;
  };
  return where_learned(correction, load_n, motion, forces, add);
}

SlopedForces corrected(const GenericCorrection& correction, double load_n,
                       const WheelMotion& motion, SlopedForces forces) {
  const auto add = [&](SlopedForces sum, const ForwardMotion& forward,
                       const CorrectionPoint& point) {
    const SlopedCorrection added = correction_at(correction, point);
    const double sx = forward.x_sign, sy = forward.y_sign;
    // of slip ratio and |slip angle| over the rim speed a, |Vx| and |Vy|
    const double a = std::abs(motion.rim_speed_mps), b = std::abs(motion.vx_mps);
    const double c = std::abs(motion.vy_mps), v2 = b * b + c * c;
    const double slip_by_a = a >= b ? b / (a * a) : 1 / b;
    const double slip_by_b = a >= b ? -1 / a : -a / (b * b);
    const double angle_by_b = v2 > 0 ? -c / v2 : 0, angle_by_c = v2 > 0 ? b / v2 : 0;
    const auto add_channel = [&](SlopedForce& force, double CorrectionValue::*channel,
                                 double own_sign, double by_vy_sign) {
      const double by_slip = added.by_slip_ratio.*channel;
      const double by_angle = added.by_slip_angle.*channel;
      force.value_n += own_sign * added.value.*channel;
      force.by_load += own_sign * added.by_log_load.*channel / load_n;
      force.by_vx_nspm += own_sign * sx * (by_slip * slip_by_b + by_angle * angle_by_b);
      force.by_vy_nspm += by_vy_sign * by_angle * angle_by_c;
      force.by_rim_speed_nspm += own_sign * sx * by_slip * slip_by_a;
    };
    add_channel(sum.fx, &CorrectionValue::fx_n, sx, sx * sy);
    // Also at slip angle 0, where it rises through 0.
    add_channel(sum.fy, &CorrectionValue::fy_n, sy, 1);
    sum.torque_nm += sx * added.value.torque_nm;
    return sum;
  };
  return where_learned(correction, load_n, motion, forces, add);
}

}  // namespace regoplan
