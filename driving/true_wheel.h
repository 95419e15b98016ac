#pragma once

#include "driving/drive_truth.h"
#include "terramech/wheel/wheel_model.h"

namespace regoplan {

/// A wheel with its faults on one soil: what gives its forces when the vehicle's dynamics ask with
/// the motion that they take the wheel to have, in the frame that its steering is commanded to.
class TrueWheel {
 public:
  /// \param spec of the wheel without its faults \param pass how many wheels have come by, this
  /// one included
  TrueWheel(WheelModelSpec spec, const WheelFault& fault, int pass);

  /// Forces in the commanded frame; the torque includes the drag.
  WheelForces forces(double load_n, const WheelMotion& commanded) const;

  /// The motion in the wheel's own frame.
  WheelMotion true_motion(const WheelMotion& commanded) const;

 private:
  WheelFault fault_;
  WheelModel model_;
  WheelConditions conditions_;
  bool plain_;  ///< neither passes nor mechanisms: the model's shorter way
  double cos_offset_, sin_offset_;
};

}  // namespace regoplan
