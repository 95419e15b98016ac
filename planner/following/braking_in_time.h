#pragma once

#include <functional>
#include <vector>

#include "planner/following/reference_path.h"

namespace regoplan {

/// The fastest rim speeds along a leg from which the rims, at their limited rate, still come down
/// in time to all that is fed forward farther on. To brake, wheels first have to go from driving
/// slip to braking slip: their rims slow down before, and by more than, the vehicle.
class BrakingInTime {
 public:
  /// \param leg must outlive it \param apart_m of the places that are looked at
  /// \param rate_mps2 of the rims \param rim_mps fed forward at a place along the leg, at least 0
  BrakingInTime(const PathLeg& leg, double apart_m, double rate_mps2,
                const std::function<double(double s_m)>& rim_mps);
  /// At a place along the leg.
  double most_mps(double s_m) const;

 private:
  const PathLeg& leg_;
  double apart_m_, rate_mps2_;
  std::vector<double> most_mps_;  ///< at stations
};

}  // namespace regoplan
