#pragma once

#include <optional>
#include <string>
#include <vector>

#include "drive_diagnosis/comparison/window_prediction.h"
#include "drive_diagnosis/instruments/mounting.h"

namespace regoplan {

/// Numbers of a vehicle that nobody knows well, each with how far it may be off; one that is not
/// given is as well known as a sound vehicle's. The vehicle itself holds the values.
struct UncertainVehicle {
  std::optional<DriveEstimate> mass_kg, wheel_radius_m;
  /// By which a wheel's recorded torque, or its current where no torque is recorded, is multiplied
  /// to get N m.
  std::optional<DriveEstimate> motor_constant;
};

/// Something of vehicle, sensors or soil that may be otherwise, by one number.
struct VehicleTrial {
  std::string id;         ///< of the effect, `steering_offset`; empty: a parameter, never claimed
  std::string parameter;  ///< what it is told in, `steer_front_deg`
  double unit = 1;        ///< of the parameter: what a sound vehicle is off, one standard deviation
  VehicleDeviation deviation;  ///< of that size
  std::string beside;          ///< of a parameter: the effect that sets it free once it is claimed
  /// A drag: nothing that drags makes a vehicle go by itself, so that none is less than 0.
  bool is_drag() const { return id.ends_with("_drag"); }
  /// By which something that is positive is more than it is said to be: more than -1.
  bool is_share() const { return parameter.ends_with("_share"); }
};

/// Everything that may be otherwise all along: faults, and numbers of the map's soils.
/// \param soils that were driven on, by index \param attitude_follows whether pitch and roll
/// go with the map's ground: nothing else tells higher slopes from torques told too large
std::vector<VehicleTrial> vehicle_trials(const Vehicle& vehicle, double gravity_mps2,
                                         const UncertainVehicle& uncertain, const TerrainMap& map,
                                         const std::vector<bool>& soils, bool attitude_follows);

/// The numbers of a vehicle that nobody knew well, as they are estimated.
/// \param sizes, stds of each trial
UncertainVehicle estimated_vehicle(const UncertainVehicle& said,
                                   const std::vector<VehicleTrial>& trials,
                                   const Eigen::VectorXd& sizes, const Eigen::VectorXd& stds);

/// What is left of the spread of each soil's numbers, in standard deviations: 1 where no trial is
/// of it. \param stds of each trial
std::vector<SoilNumbers> soil_stds(const std::vector<VehicleTrial>& trials,
                                   const Eigen::VectorXd& stds, std::size_t soils);

/// Indices of the trials that a soil's numbers are.
std::vector<std::size_t> trials_of_soil(const std::vector<VehicleTrial>& trials, std::size_t soil);

}  // namespace regoplan
