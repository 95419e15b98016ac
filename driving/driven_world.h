#pragma once

#include <string>
#include <vector>

#include "planner/course/path_curve.h"
#include "terramech/margins/state_margins.h"
#include "terramech/vehicle/vehicle_dynamics.h"

namespace regoplan {

/// One wheel at a moment.
struct WheelNow {
  double load_n = 0;
  double steer_rad = 0;       ///< as commanded
  double rim_speed_mps = 0;   ///< turning rate times the known radius
  double slip = 0;            ///< 0 near rest, where a wheel creeps
  double slip_angle_rad = 0;  ///< likewise
  double torque_nm = 0;       ///< true, drag included
  double sinkage_m = 0;
};

/// A world that can be driven in. States are those of the known vehicle: of the point below the
/// centre of gravity as it is taken to be.
class DrivenWorld {
 public:
  virtual ~DrivenWorld() = default;

  virtual const Vehicle& known_vehicle() const = 0;
  virtual StepResult step(const VehicleState& state, const VehicleControl& control,
                          double duration_s) const = 0;
  /// Every wheel, in the vehicle's order. \pre the ground is known
  virtual std::vector<WheelNow> wheels(const VehicleState& state) const = 0;
  /// The ground that a state stands on.
  virtual GroundPatch ground(const VehicleState& state) const = 0;
  /// Margins of the manoeuvre that a state commands. \param patch the ground there
  virtual StateMargins margins(const VehicleState& state, const GroundPatch& patch) const = 0;
  virtual bool at_rest(const VehicleState& state) const = 0;
  /// The place on the planned map that really lies here.
  virtual PathPoint on_the_map(double x_m, double y_m) const = 0;
  /// Torque of a wheel that is measured, over the true one.
  virtual double motor_constant_factor(std::size_t wheel) const = 0;
};

}  // namespace regoplan
