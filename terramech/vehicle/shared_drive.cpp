// Wheels that share one torque: open differentials, or motors on one current. Their rim speeds are
// those at which each has that torque, and their mean is the mean of the commanded ones.
#include <algorithm>
#include <cmath>
#include <limits>

#include "terramech/vehicle/wheel_sums.h"

namespace regoplan {

/// The torque at which the driven rims turn at their commanded speeds on average, by bracketing it,
/// each wheel solved for each torque: slow, and for all that wheels may do.
double VehicleWheels::bracketed_torque_nm(const BodyMotion& motion, const WheelSetting& setting,
                                          const GroundPatch& patch,
                                          const GroundReaction& reaction) const {
  double most_nm = 0, axle_mps = 0;
  const auto excess_mps = [&](double torque_nm) {
    return sum_by_side(vehicle_, 0.0, [&](double& sum, std::size_t i) {
      const double load = sharing_.load_n(i, reaction);
      if (!vehicle_.wheels[i].driven || !(load > 0)) return;
      const WheelOnGround wheel = on_ground(i, motion, setting, patch);
      const WheelMotion& at = wheel.at;
      most_nm = std::max(most_nm, load * vehicle_.wheel.radius_m);
      axle_mps = std::max(axle_mps, std::abs(at.vx_mps));
      sum += response(i, wheel.law, load, at, torque_nm).rim_speed_mps - at.rim_speed_mps;
    });
  };
  const double limit = vehicle_.torque_max_nm.value_or(std::numeric_limits<double>::infinity());
  double low = 0, f_low = excess_mps(0);
  most_nm = std::min(2 * most_nm, limit);
  double high = f_low < 0 ? most_nm : -most_nm, f_high = excess_mps(high);
  if (f_low * f_high >= 0) return f_low == 0 ? 0 : high;
  for (int i = 0; i < 100; ++i) {
    constexpr double kCloseShare = 1e-12;
    const double middle =
        i % 4 == 3 ? (low + high) / 2 : high - f_high * (high - low) / (f_high - f_low);
    const double f = excess_mps(middle);
    const bool close = std::abs(middle - high) <= kCloseShare * most_nm;
    if (f * f_high < 0) {
      low = high;
      f_low = f_high;
    } else {
      f_low /= 2;
    }
    high = middle;
    f_high = f;
    if (close || f == 0) break;
  }
  return high;
}

/// By Newton's method in the torque and all rim speeds at once; where that does not settle, or a
/// motor's limit is passed, the torque alone.
VehicleWheels::SharedDrive VehicleWheels::shared_drive(const BodyMotion& motion,
                                                       const WheelSetting& setting,
                                                       const GroundPatch& patch,
                                                       const GroundReaction& reaction) const {
  struct Driven {
    const WheelLaw* law;
    double load_n;
    WheelMotion at;
    double commanded_mps;
  };
  std::array<Driven, kMaxWheels> wheels{};
  std::array<bool, kMaxWheels> counts{};
  double scale_mps = kStandstill_mps, most_nm = 0;
  for (std::size_t i = 0; i < vehicle_.wheels.size(); ++i) {
    const double load = sharing_.load_n(i, reaction);
    counts.at(i) = vehicle_.wheels[i].driven && load > 0;
    if (!counts.at(i)) continue;
    const WheelOnGround wheel = on_ground(i, motion, setting, patch);
    const double commanded = wheel.at.rim_speed_mps;
    wheels.at(i) = {&wheel.law, load, wheel.at, commanded};
    scale_mps = std::max({scale_mps, std::abs(commanded), std::abs(wheels.at(i).at.vx_mps)});
    most_nm = std::max(most_nm, load * vehicle_.wheel.radius_m);
  }
  const double limit_nm = vehicle_.torque_max_nm.value_or(std::numeric_limits<double>::infinity());
  constexpr double kStepShare = 1e-3;  // wider than what tables wobble at no slip
  double worst_before_nm = std::numeric_limits<double>::infinity();
  SharedDrive drive;
  for (int iteration = 0; iteration < 25; ++iteration) {
    // Each wheel follows a change of the torque by its own slope; the mean of the rims is held.
    struct Sum {
      double excess_mps = 0, missing_mps = 0, softness = 0;
      Sum operator+(const Sum& o) const {
        return {excess_mps + o.excess_mps, missing_mps + o.missing_mps, softness + o.softness};
      }
    };
    std::array<double, kMaxWheels> missing_nm{}, slope{};
    bool rises = true;
    double worst_nm = 0;
    const Sum sum = sum_by_side(vehicle_, Sum{}, [&](Sum& of_side, std::size_t i) {
      if (!counts.at(i)) return;
      const Driven& wheel = wheels.at(i);
      const auto torque_at = [&](double rim_mps) {
        return faded(*wheel.law, wheel.load_n, {wheel.at.vx_mps, wheel.at.vy_mps, rim_mps})
            .torque_nm;
      };
      const double rim = wheel.at.rim_speed_mps;
      const double h = std::copysign(kStepShare * scale_mps, rim);
      const double torque = torque_at(rim);
      slope.at(i) = (torque_at(rim + h) - torque) / h;
      missing_nm.at(i) = drive.torque_nm - torque;
      rises = rises && slope.at(i) > 0;
      worst_nm = std::max(worst_nm, std::abs(missing_nm.at(i)));
      of_side.excess_mps += rim - wheel.commanded_mps;
      of_side.missing_mps += missing_nm.at(i) / slope.at(i);
      of_side.softness += 1 / slope.at(i);
    });
    constexpr double kBalanced = 1e-11, kAccepted = 1e-6;  // tables are rounded to floats
    const bool stalls = worst_nm <= kAccepted * most_nm && worst_nm > worst_before_nm / 2;
    worst_before_nm = worst_nm;
    if (iteration > 0 && (stalls || worst_nm <= kBalanced * most_nm)) {
      if (std::abs(drive.torque_nm) > limit_nm) break;
      drive.rims_known = true;
      for (std::size_t i = 0; i < wheels.size(); ++i) {
        drive.rim_speed_mps.at(i) = wheels.at(i).at.rim_speed_mps;
      }
      return drive;
    }
    if (!rises) break;
    const double more_nm = -(sum.excess_mps + sum.missing_mps) / sum.softness;
    drive.torque_nm += more_nm;
    double farthest = 0;
    for (std::size_t i = 0; i < vehicle_.wheels.size(); ++i) {
      if (!counts.at(i)) continue;
      const double step = (missing_nm.at(i) + more_nm) / slope.at(i);
      wheels.at(i).at.rim_speed_mps += step;
      farthest = std::max(farthest, std::abs(step));
    }
    if (!(farthest < 2 * scale_mps)) break;
  }
  return {.torque_nm = bracketed_torque_nm(motion, setting, patch, reaction)};
}

}  // namespace regoplan
