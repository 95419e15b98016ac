#pragma once

#include "terramech/wheel/wheel_contact.h"
#include "terramech/wheel/wheel_model.h"

namespace regoplan {

/// A motion told as ratios of a wheel that goes forward, and what turns the forces back.
struct ForwardMotion {
  wheel_contact::Ratios ratios;
  double x_sign = 1;  ///< -1: evaluated mirrored, Fx and T change sign
  double y_sign = 0;
  WheelStatus status = WheelStatus::kOk;
};

/// Of any motion: reverse is mirrored, a rim against the travel counts as locked.
ForwardMotion forward_motion(const WheelMotion& motion);

}  // namespace regoplan
