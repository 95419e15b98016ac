#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planner/chart/feasibility_chart.h"
#include "python/physics/wheel_source.h"
#include "terramech/margins/margin_judge.h"
#include "terramech/parameters/vehicle.h"

namespace regoplan::python {

/// A moment of steady driving on a plane of one soil.
struct Moment {
  double speed_mps = 0;
  double curvature_1pm = 0;  ///< commanded, left positive
  double acceleration_mps2 = 0;
  double slope_forward_rad = 0;  ///< the ground rises ahead
  double slope_left_rad = 0;     ///< and to the left
};

/// A trim, or what ends the branch of trims before it is reached.
struct TrimAnswer {
  std::optional<Trim> trim;
  std::string limit;  ///< empty where there is a trim
  int wheel = -1;     ///< at which the limit is reached
};

/// A vehicle all of whose wheels stand on one soil, judged by `MarginJudge` as plans and charts
/// are.
class VehicleOnSoil {
 public:
  /// \param wheel made for the vehicle's wheel
  VehicleOnSoil(Vehicle vehicle, WheelSource wheel, double gravity_mps2);
  VehicleOnSoil(const VehicleOnSoil&) = delete;
  VehicleOnSoil& operator=(const VehicleOnSoil&) = delete;

  StateMargins margins(const Moment& moment) const;
  SupplyResult supply(const Moment& moment) const;
  /// On the branch of trims that is connected to no lateral force.
  TrimAnswer trim(const Moment& moment) const;

  /// As the chart of `evaluate` finds it, with its fast wheel model and its precision of 1 %.
  SafeCurvature largest_safe_curvature(double speed_mps, double slope_left_rad,
                                       double margin_min) const;

  const Vehicle& vehicle() const { return vehicle_; }

 private:
  GroundPatch patch_of(const Moment& moment) const;
  VehicleState state_of(const Moment& moment) const;

  Vehicle vehicle_;
  WheelSource wheel_;
  std::vector<WheelLaw> laws_;            ///< one soil
  std::vector<WheelLaw> laws_of_wheels_;  ///< the same for every wheel
  VehicleDynamics dynamics_;
  MarginJudge judge_;
};

/// A vehicle from the keys of a vehicle file, from a file, or a preset. \throws InputError
Vehicle vehicle_from(const std::string& settings);
Vehicle vehicle_from_file(const std::string& file);
/// The keys of a vehicle file, as JSON.
std::string vehicle_settings(const Vehicle& vehicle);

}  // namespace regoplan::python
