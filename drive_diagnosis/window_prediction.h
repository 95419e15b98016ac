#pragma once

#include <array>
#include <optional>
#include <vector>

#include "maps/terrain_map.h"
#include "terramech/steered_wheel.h"
#include "terramech/vehicle.h"
#include "terramech/wheel_model.h"

namespace regoplan {

/// What a window gives the model: where the vehicle is, and what its wheels are set to.
struct WindowInput {
  double x_m = 0, y_m = 0, yaw_rad = 0;
  double acceleration_mps2 = 0;  ///< measured, along the heading
  double speed_mps = 0;          ///< measured, along the heading: where the search starts
  double yaw_rate_rad_s = 0;     ///< measured likewise
  std::array<double, kMaxWheels> rim_rad_s{};
  std::array<double, kMaxWheels> steer_rad{};
};

/// What the model says of a window; velocities are horizontal.
struct WindowPrediction {
  double forward_mps = 0, left_mps = 0, yaw_rate_rad_s = 0;
  std::array<double, kMaxWheels> torque_nm{};
};

/// What may be otherwise with the vehicle or the ground than it is said to be; all 0 is as said.
struct VehicleDeviation {
  std::array<double, kMaxWheels> wheel_drag_nm{};
  std::array<double, kMaxWheels> steering_offset_rad{};
  double radius_share = 0;   ///< of the wheels' radius
  double payload_share = 0;  ///< of the mass
  double cg_forward_m = 0, cg_left_m = 0, cg_up_m = 0;
  double motor_share = 0;                  ///< of the torque told
  double tow_drag_n = 0;                   ///< pulls back at the centre of gravity
  double map_east_m = 0, map_north_m = 0;  ///< by which the map lies off
  double weaker_soil = 0;                  ///< standard deviations of `weaker`
};

/// A soil so many standard deviations weaker: friction, cohesion and bearing moduli less. A number
/// without a deviation of its own counts as known to a tenth.
Soil weaker(const UncertainSoil& soil, double deviations);

/// Steady motion of a vehicle whose wheels turn and steer as measured: the body's velocities at
/// which the wheels' forces, gravity and the measured acceleration balance.
class WindowModel {
 public:
  /// All must outlive it.
  WindowModel(const TerrainMap& map, const Vehicle& vehicle, double gravity_mps2);

  /// Nothing where the ground is not known or no motion balances.
  std::optional<WindowPrediction> predict(const WindowInput& input,
                                          const VehicleDeviation& deviation) const;

 private:
  const TerrainMap& map_;
  const Vehicle& vehicle_;
  double gravity_mps2_;
};

}  // namespace regoplan
