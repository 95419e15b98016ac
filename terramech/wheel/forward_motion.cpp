#include "terramech/wheel/forward_motion.h"

#include <algorithm>
#include <cmath>

#include "terramech/parameters/trusted_range.h"

namespace regoplan {

ForwardMotion forward_motion(const WheelMotion& motion) {
  ForwardMotion forward;
  double w = motion.rim_speed_mps;
  double vx = motion.vx_mps;
  const double vy = std::abs(motion.vy_mps);
  if (w == 0 && vx == 0 && vy == 0) {
    forward.ratios = {.rim = 0, .axle = 0};
    forward.status = WheelStatus::kStandstill;
    return forward;
  }
  if (w * vx < 0) {
    w = 0;
    forward.status = WheelStatus::kCounterRotating;
  }
  if (w < 0 || (w == 0 && vx < 0)) {
    w = -w;
    vx = -vx;
    forward.x_sign = -1;
  }
  forward.y_sign = motion.vy_mps > 0 ? 1 : motion.vy_mps < 0 ? -1 : 0;
  constexpr double kMobilised = 1e12;  // a displacement ratio that shears fully
  wheel_contact::Ratios& ratios = forward.ratios;
  ratios.beta_abs_rad = std::atan2(vy, vx);
  if (w == 0) {
    ratios.rim = 0;
    ratios.axle = vx > 0 ? kMobilised : 0;
    ratios.lateral = vy > 0 ? kMobilised : 0;
    ratios.slip = vx > 0 ? -1 : 0;
  } else {
    ratios.axle = std::min(vx / w, kMobilised);
    ratios.lateral = std::min(vy / w, kMobilised);
    ratios.slip = ratios.axle <= 1 ? 1 - ratios.axle : 1 / ratios.axle - 1;
  }
  if (forward.status == WheelStatus::kOk && !is_trusted(ratios.slip, ratios.beta_abs_rad)) {
    forward.status = WheelStatus::kUntrusted;
  }
  return forward;
}

}  // namespace regoplan
