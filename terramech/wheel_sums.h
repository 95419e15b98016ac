#pragma once

#include <Eigen/Core>
#include <array>
#include <span>

#include "terramech/ground_patch.h"
#include "terramech/steered_wheel.h"
#include "terramech/vehicle.h"
#include "terramech/wheel_law.h"
#include "terramech/wheel_loads.h"

namespace regoplan {

/// The largest strains on the wheels.
struct WheelStrain {
  double slip = 0;            ///< largest by magnitude, signed
  double slip_angle_rad = 0;  ///< largest by magnitude, signed
  double sinkage_m = 0;       ///< the wheel's radius where one sinks to its axle
  double load_min_n = 0;      ///< 0 or less: a wheel lifts
  double torque_max_nm = 0;   ///< largest by magnitude, signed
};

/// What steering and motors are set to at a moment.
struct WheelSetting {
  std::array<SteeredWheel, kMaxWheels> wheels;
  double rim_speed = 0;  ///< m/s; rad/s of the rotation when set for turning on the spot
};

/// The forces of all wheels on a moving vehicle, body frame.
struct WheelSums {
  BodyForce force;
  WheelStrain strain;
  double drive_power_w = 0;  ///< torque times turning rate of the wheels that drive
  bool as_commanded = true;  ///< every wheel turns at its commanded speed
};

/// With slopes.
struct SlopedWheelSums {
  WheelSums sums;
  Eigen::Matrix3d slopes = Eigen::Matrix3d::Zero();  ///< by (vx, vy, yaw rate), loads held
  /// Change of the force on the way to the next setting, to first order.
  Eigen::Vector3d by_setting = Eigen::Vector3d::Zero();
  /// Every wheel turns at its commanded speed along its motion, well above standstill: `slopes` and
  /// `by_setting` describe the forces nearby.
  bool smooth = true;
};

/// The wheels of a vehicle, each on its soil: the wheel model's forces at the motion of each
/// contact, with the rim speeds that the drive law and the motors' torque limit give. Near
/// standstill the forces fade with the speed that they oppose, because a locked wheel shears the
/// soil fully along either of its axes, whichever way it slides: else its forces would jump.
class VehicleWheels {
 public:
  static constexpr double kStandstillSpeed_mps = 1e-3;

  /// \param soil_laws by the ground's soil indices; all must outlive this
  VehicleWheels(const Vehicle& vehicle, std::span<const WheelLaw> soil_laws);

  WheelSums sums(const BodyMotion& motion, const WheelSetting& setting, const GroundPatch& patch,
                 const GroundReaction& reaction) const;

  /// \param next setting that `by_setting` leads to
  SlopedWheelSums sums_with_slopes(const BodyMotion& motion, const WheelSetting& setting,
                                   const WheelSetting& next, const GroundPatch& patch,
                                   const GroundReaction& reaction) const;

  /// Largest slip and slip angle, from the motion alone, where rims turn at commanded speeds.
  WheelStrain with_slips(WheelStrain strain, const BodyMotion& motion, const WheelSetting& setting,
                         const GroundReaction& reaction) const;

  const LoadSharing& sharing() const { return sharing_; }

 private:
  struct Response;
  double commanded_rim_mps(std::size_t wheel, const WheelSetting& setting) const;
  Response response(std::size_t wheel, const WheelLaw& law, double load_n, WheelMotion at,
                    double shared_torque_nm) const;
  double shared_torque_nm(const BodyMotion& motion, const WheelSetting& setting,
                          const GroundPatch& patch, const GroundReaction& reaction) const;

  const Vehicle& vehicle_;
  std::span<const WheelLaw> soil_laws_;
  LoadSharing sharing_;
  std::size_t driven_ = 0;
};

}  // namespace regoplan
