#pragma once

#include <array>
#include <vector>

#include "drive_diagnosis/comparison/soil_deviation.h"
#include "terramech/parameters/ground_patch.h"

namespace regoplan {

/// What may be otherwise with the vehicle or the ground than it is said to be; all 0 is as said.
struct VehicleDeviation {
  std::array<double, kMaxWheels> wheel_drag_nm{};  ///< against the way that each wheel turns
  std::array<double, kMaxWheels> steering_offset_rad{};
  std::array<double, kMaxWheels> motor_share{};  ///< of the torque told
  /// By how much torque over radius, and drawbar pull, of a wheel that bears more than the mean of
  /// all are above the wheel model's: as a share of its load, per share that it bears more.
  double torque_by_load = 0, pull_by_load = 0;
  double radius_share = 0;                              ///< of the wheels' radius
  std::array<double, kMaxWheels> wheel_radius_share{};  ///< of one wheel's, as it rolls
  std::array<double, kMaxWheels> wheel_speed_late_s{};  ///< that wheel speeds are told late
  double attitude_late_s = 0;                           ///< that pitch and roll are
  double payload_share = 0;                             ///< of the mass
  double cg_forward_m = 0, cg_left_m = 0, cg_up_m = 0;
  double tow_drag_n = 0;                   ///< at the centre of gravity, against the way
  double map_east_m = 0, map_north_m = 0;  ///< by which the map lies off
  double map_height_share = 0;             ///< by which the ground's heights are the map's and more
  double soil_east_m = 0, soil_north_m = 0;  ///< by which its soils lie off besides
  /// By which pitch and roll are more than those of the ground: wheels that sink deeper downhill.
  double tilt_share = 0;
  double mounting_pitch_rad = 0, mounting_roll_rad = 0, mounting_yaw_rad = 0;  ///< of the sensors
  std::vector<SoilNumbers> soils;  ///< of each soil of the map; empty: none

  bool operator==(const VehicleDeviation&) const = default;
  /// Adds so many times another.
  void add(const VehicleDeviation& other, double times);
};

}  // namespace regoplan
