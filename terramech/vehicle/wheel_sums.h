#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "terramech/parameters/ground_patch.h"
#include "terramech/parameters/vehicle.h"
#include "terramech/vehicle/faded_forces.h"
#include "terramech/vehicle/steered_wheel.h"
#include "terramech/vehicle/wheel_loads.h"
#include "terramech/wheel/wheel_law.h"

namespace regoplan {

/// The largest strains on the wheels.
struct WheelStrain {
  double slip = 0;            ///< largest by magnitude, signed
  double slip_angle_rad = 0;  ///< largest by magnitude, signed
  double sinkage_m = 0;       ///< the wheel's radius where one sinks to its axle
  double load_min_n = 0;      ///< 0 or less: a wheel lifts
  double torque_max_nm = 0;   ///< largest by magnitude, signed
};

/// Collects the largest slip and slip angle, as ratios that are divided only when asked for.
class LargestSlips {
 public:
  void add(const WheelMotion& at) {
    const double rim = std::abs(at.rim_speed_mps), ahead = std::abs(at.vx_mps);
    const double aside = std::abs(at.vy_mps);
    if (!(std::max({rim, ahead, aside}) > kMoving_mps)) return;
    const double faster = std::max(rim, ahead);
    const bool against = at.rim_speed_mps * at.vx_mps < 0;
    const double excess = against ? -faster : rim - ahead;
    if (std::abs(excess) * slip_whole_ > std::abs(slip_part_) * faster) {
      slip_part_ = excess;
      slip_whole_ = faster;
    }
    if (aside * ahead_ > std::abs(aside_) * ahead) {
      aside_ = at.vy_mps;
      ahead_ = ahead;
    }
  }
  double slip() const { return slip_part_ / slip_whole_; }
  double slip_angle_rad() const { return std::atan2(aside_, ahead_); }

 private:
  static constexpr double kMoving_mps = 1e-3;  ///< slower wheels have no slip worth telling
  double slip_part_ = 0, slip_whole_ = 1, aside_ = 0, ahead_ = 1;
};

/// What steering and motors are set to at a moment.
struct WheelSetting {
  std::array<SteeredWheel, kMaxWheels> wheels;
  double rim_speed = 0;  ///< m/s; rad/s of the rotation when set for turning on the spot
};

/// The forces of all wheels on a moving vehicle, body frame.
struct WheelSums {
  BodyForce force;
  WheelStrain contact;                             ///< but for the slips
  std::array<double, kMaxWheels> rim_speed_mps{};  ///< at which the wheels turn
  double drive_power_w = 0;  ///< of each wheel while it drives; braking gives nothing back
  bool as_commanded = true;  ///< every wheel turns at its commanded speed
  bool strain_known = true;  ///< `contact` and `rim_speed_mps` are filled in
};

/// With slopes.
struct SlopedWheelSums {
  WheelSums sums;                                    ///< without strain, but under equal torque
  Eigen::Matrix3d slopes = Eigen::Matrix3d::Zero();  ///< by (vx, vy, yaw rate), loads held
  /// Change of the force on the way to the next setting, to first order.
  Eigen::Vector3d by_setting = Eigen::Vector3d::Zero();
  /// Every wheel turns at its commanded speed along its motion, well above standstill: `slopes` and
  /// `by_setting` describe the forces nearby.
  bool smooth = true;
};

/// A wheel's force (fx, -fy) in its own frame and its slopes.
struct WheelSlopes {
  double x = 0, y = 0;
  double x_by_vx = 0, x_by_vy = 0, x_by_rim = 0;
  double y_by_vx = 0, y_by_vy = 0, y_by_rim = 0;
  double torque_nm = 0;
  double rim_speed_mps = 0;  ///< at which it turns
  bool as_commanded = true;  ///< which is its commanded speed
};

/// The wheels of a vehicle, each on its soil: the wheel model's forces at the motion of each
/// contact, with the rim speeds that the drive law and the motors' torque limit give. Near
/// standstill the forces fade with the speed that they oppose.
class VehicleWheels {
 public:
  static constexpr double kStandstillSpeed_mps = kStandstill_mps;

  /// \param soil_laws by the ground's soil indices; all must outlive this
  VehicleWheels(const Vehicle& vehicle, std::span<const WheelLaw> soil_laws);

  WheelSums sums(const BodyMotion& motion, const WheelSetting& setting, const GroundPatch& patch,
                 const GroundReaction& reaction) const;

  /// \param next setting that `by_setting` leads to; `setting` itself where nothing changes
  SlopedWheelSums sums_with_slopes(const BodyMotion& motion, const WheelSetting& setting,
                                   const WheelSetting& next, const GroundPatch& patch,
                                   const GroundReaction& reaction) const;

  /// The strains of sums, with the slips that their rims have at a motion.
  WheelStrain strain(const WheelSums& sums, const BodyMotion& motion, const WheelSetting& setting,
                     const GroundReaction& reaction) const;

  const LoadSharing& sharing() const { return sharing_; }

 private:
  /// How a wheel answers: its forces, and the rim speed at which it does.
  struct Response {
    WheelForces forces;
    double rim_speed_mps = 0;
    bool as_commanded = true;
  };
  /// A wheel as it is mounted and steered, on its soil, at its commanded speed.
  struct WheelOnGround {
    const WheelMount& mount;
    const SteeredWheel& wheel;
    const WheelLaw& law;
    WheelMotion at;
  };
  WheelOnGround on_ground(std::size_t i, const BodyMotion& motion, const WheelSetting& setting,
                          const GroundPatch& patch) const;
  /// What wheels with one torque in common settle to.
  struct SharedDrive {
    double torque_nm = 0;
    bool rims_known = false;
    std::array<double, kMaxWheels> rim_speed_mps{};
  };
  WheelSlopes slopes_by_differences(std::size_t wheel, const WheelLaw& law, double load_n,
                                    const WheelMotion& at) const;
  Response response(std::size_t wheel, const WheelLaw& law, double load_n, WheelMotion at,
                    double shared_torque_nm) const;
  SharedDrive shared_drive(const BodyMotion& motion, const WheelSetting& setting,
                           const GroundPatch& patch, const GroundReaction& reaction) const;
  double bracketed_torque_nm(const BodyMotion& motion, const WheelSetting& setting,
                             const GroundPatch& patch, const GroundReaction& reaction) const;

  const Vehicle& vehicle_;
  std::span<const WheelLaw> soil_laws_;
  LoadSharing sharing_;
  std::size_t driven_ = 0;
};

}  // namespace regoplan
