#pragma once

#include <algorithm>
#include <cmath>

#include "terramech/basics/bracketed_root.h"

namespace regoplan {

/// Rim speed at which a wheel's torque is the wanted one, for wheels that are given a torque and
/// not a speed: those that roll freely, share a differential, or whose motor is too weak.
/// The torque grows with the rim speed; where the soil holds less than the wanted torque the wheel
/// spins (50 times the axle's speed), where it takes more to turn it backwards likewise.
/// \param torque_at torque in N m over the rim speed, not falling \param wanted_nm the torque
/// \param vx_mps speed of the axle along the wheel \param least_mps scale at standstill, above 0
template <class Torque>
double rim_speed_at_torque(const Torque& torque_at, double wanted_nm, double vx_mps,
                           double least_mps) {
  constexpr double kSpinning = 50, kFirst = 0.05;
  const double scale = std::max(std::abs(vx_mps), least_mps);
  double low = vx_mps, f_low = torque_at(low) - wanted_nm;
  if (f_low == 0) return low;
  const double direction = f_low < 0 ? 1 : -1;
  // Outward from rolling without slip until the torque is passed.
  double high = low, f_high = f_low, reach = kFirst * scale;
  while (f_high * f_low > 0) {
    if (std::abs(high - vx_mps) >= kSpinning * scale) return high;
    low = high;
    f_low = f_high;
    high = vx_mps + direction * reach;
    f_high = torque_at(high) - wanted_nm;
    reach *= 2;
  }
  constexpr double kClose = 1e-10;
  return bracketed_root([&](double rim_mps) { return torque_at(rim_mps) - wanted_nm; },
                        {.from = low, .f_from = f_low, .to = high, .f_to = f_high},
                        {.argument = kClose * scale});
}

}  // namespace regoplan
