#pragma once

#include <optional>
#include <vector>

#include "driving/drive_truth.h"
#include "driving/driven_world.h"
#include "driving/true_wheel.h"
#include "planner/problem/world.h"

namespace regoplan {

/// The known vehicle with what a truth says of it.
/// \throws ValueError or InputError where that is no valid vehicle
Vehicle true_vehicle(Vehicle vehicle, const DriveTruth& truth);

/// The planned world with what a truth says of it.
class TrueWorld : public DrivenWorld {
 public:
  /// \param planned must outlive it \throws ValueError or InputError for a truth that cannot be: a
  /// soil, a wheel or a vehicle that is not valid, a name that is no wheel's
  TrueWorld(const PlanningProblem& planned, const DriveTruth& truth);
  TrueWorld(const TrueWorld&) = delete;
  TrueWorld& operator=(const TrueWorld&) = delete;

  StepResult step(const VehicleState& state, const VehicleControl& control,
                  double duration_s) const override;

  std::vector<WheelNow> wheels(const VehicleState& state) const override;

  StateMargins margins(const VehicleState& state, const GroundPatch& patch) const override;

  /// Soils count among the true ones.
  GroundPatch ground(const VehicleState& state) const override;

  bool at_rest(const VehicleState& state) const override;

  PathPoint on_the_map(double x_m, double y_m) const override;

  /// Name of the soil at a place: the map's, or the zone's; empty where it is unknown.
  std::string soil_name(double x_m, double y_m) const;

  const Vehicle& known_vehicle() const override { return planned_.vehicle; }
  double motor_constant_factor(std::size_t wheel) const override;

 private:
  GroundPatch ground_at(double x_m, double y_m, double yaw_rad) const;
  std::optional<std::size_t> soil_at(double x_m, double y_m) const;
  VehicleState to_true(VehicleState known) const;
  VehicleState to_known(VehicleState true_state, const VehicleState& commanded) const;
  double true_curvature_1pm(double known_1pm) const;

  const PlanningProblem& planned_;
  DriveTruth truth_;
  Vehicle vehicle_;                ///< the true one
  std::vector<TrueWheel> wheels_;  ///< by soil, then wheel
  std::vector<WheelLaw> laws_;
  GroundFinder ground_;
  VehicleDynamics dynamics_;
  VehicleWheels wheel_sums_;
  SupportPolygon polygon_;
};

}  // namespace regoplan
