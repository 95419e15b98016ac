#pragma once

#include <vector>

#include "terramech/parameters/vehicle.h"

namespace regoplan {

/// What the ground must carry, told at the point of the ground plane below the centre of gravity.
struct GroundReaction {
  double normal_n = 0;   ///< sum of the wheels' loads
  double forward_n = 0;  ///< sum of the wheels' forces along the body's x
  double left_n = 0;     ///< sum of the wheels' forces along the body's y
};

/// Quasi-static sharing of the load between the wheels of a vehicle: linear in the ground reaction.
/// The wheels' forces act in the ground plane, their sum is balanced at the centre of gravity:
/// sum N = normal, sum N x = -h forward, sum N y = -h left. Equal springs close this for any number
/// of wheels; a rocker-bogie shares each side's load by the levers of rocker and bogie, the body's
/// pitch moment equally by the differential (the height of the pivots above ground is left out).
class LoadSharing {
 public:
  /// \pre `validate(vehicle)` passes
  explicit LoadSharing(const Vehicle& vehicle);

  /// Load of each wheel in newtons, in the vehicle's order; 0 or less where a wheel would lift.
  std::vector<double> loads_n(const GroundReaction& reaction) const;
  double load_n(std::size_t wheel, const GroundReaction& reaction) const {
    const Share& share = shares_[wheel];
    return share.of_normal * reaction.normal_n + share.of_forward * reaction.forward_n +
           share.of_left * reaction.left_n;
  }

 private:
  struct Share {
    double of_normal = 0, of_forward = 0, of_left = 0;
  };
  std::vector<Share> shares_;
};

}  // namespace regoplan
