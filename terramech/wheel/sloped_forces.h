#pragma once

#include "terramech/wheel/wheel_model.h"

namespace regoplan {

/// Value and slopes of a force over the load and the motion in the wheel frame.
struct SlopedForce {
  double value_n = 0;
  double by_load = 0;            ///< d/d(load_n)
  double by_vx_nspm = 0;         ///< d/d(vx_mps)
  double by_vy_nspm = 0;         ///< d/d(vy_mps)
  double by_rim_speed_nspm = 0;  ///< d/d(rim_speed_mps)
};

/// The forces in the plane of the ground with their slopes, signs as in WheelForces.
struct SlopedForces {
  SlopedForce fx, fy;
  double torque_nm = 0;
  WheelStatus status = WheelStatus::kOk;
};

}  // namespace regoplan
