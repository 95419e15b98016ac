#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "terramech/basics/angles.h"
#include "terramech/margins/supply.h"
#include "terramech/parameters/ground_patch.h"
#include "terramech/parameters/vehicle.h"
#include "terramech/wheel/wheel_law.h"
#include "tests/terramech/named_soils.h"

namespace regoplan {

using named_soils::firm_regolith;
using named_soils::home_gravity_mps2;
using named_soils::kEarth_mps2;
using named_soils::kMoon_mps2;
using named_soils::loose_regolith;
using named_soils::soft_patch;

inline TrimLimits limits_of(const Vehicle& vehicle) {
  return {.slip_angle_max_rad = vehicle.slip_angle_max_rad,
          .slip_max = vehicle.slip_max,
          .sinkage_max_m = vehicle.sinkage_max_m,
          .steer_angle_max_rad = vehicle.steer_angle_max_rad,
          .torque_max_nm = vehicle.torque_max_nm.value_or(std::numeric_limits<double>::infinity())};
}

/// A vehicle on ground of one soil. Neither copied nor moved: laws point into it.
struct VehicleOnSoil {
  Vehicle vehicle;
  double gravity_mps2;
  WheelModel model;
  std::vector<WheelLaw> soil_laws{WheelLaw(model)};
  std::vector<WheelLaw> wheel_laws;
  LoadSharing sharing;

  VehicleOnSoil(const Vehicle& on, const Soil& soil, double gravity,
                WheelAccuracy accuracy = WheelAccuracy::kExact)
      : vehicle(on),
        gravity_mps2(gravity),
        model({.variant = WheelVariant::kIshigami2007,
               .wheel = on.wheel,
               .soil = soil,
               .gravity_mps2 = gravity},
              accuracy),
        wheel_laws(on.wheels.size(), WheelLaw(model)),
        sharing(vehicle) {}
  explicit VehicleOnSoil(const std::string& preset, const Soil& soil = firm_regolith())
      : VehicleOnSoil(preset_vehicle(preset), soil, home_gravity_mps2(preset)) {}
  VehicleOnSoil(const VehicleOnSoil&) = delete;
  VehicleOnSoil& operator=(const VehicleOnSoil&) = delete;

  double weight_n() const { return vehicle.mass_kg * gravity_mps2; }
  SteadyManoeuvre manoeuvre(double curvature_1pm, bool reverse = false, double crab_rad = 0) const {
    return {vehicle, sharing, wheel_laws, curvature_1pm, weight_n(), reverse, crab_rad};
  }
  SupplyResult supply(double curvature_1pm, double forward_n = 0, bool find_folds = false) const {
    return cornering_supply(manoeuvre(curvature_1pm), forward_n, limits_of(vehicle), find_folds);
  }
};

/// Ground of soil 0 with the given slopes in the vehicle's heading.
inline GroundPatch patch_with(double slope_forward, double slope_left) {
  return {.known = true,
          .z_m = 0,
          .slope_forward = slope_forward,
          .slope_left = slope_left,
          .soil = {}};
}

/// A plane in the map frame, z = slope_x x + slope_y y, of soil 0.
struct Plane {
  double slope_x = 0;
  double slope_y = 0;
  GroundPatch operator()(double x_m, double y_m, double yaw_rad) const {
    const double c = std::cos(yaw_rad), s = std::sin(yaw_rad);
    GroundPatch patch = patch_with(c * slope_x + s * slope_y, c * slope_y - s * slope_x);
    patch.z_m = slope_x * x_m + slope_y * y_m;
    return patch;
  }
};

/// A vehicle on three wheels, one ahead.
inline Vehicle tricycle() {
  Vehicle vehicle = preset_vehicle("lrv");
  vehicle.name = "tricycle";
  vehicle.wheels = {
      {"front", 1.4, 0, true}, {"rear_left", -0.7, 0.9, false}, {"rear_right", -0.7, -0.9, false}};
  vehicle.turn_centre_x_m = -0.7;
  vehicle.curvature_max_1pm = 0.35;
  return vehicle;
}

/// A short LRV whose wheels do not steer: the rims of its sides turn apart. (A long one spins its
/// wheels beyond their best slip when it turns on the spot, and drifts.)
inline Vehicle skid_steered() {
  Vehicle vehicle = preset_vehicle("lrv");
  vehicle.name = "skid";
  vehicle.steering = Steering::kSkid;
  for (WheelMount& wheel : vehicle.wheels) {
    wheel.steered = false;
    wheel.x_m *= 0.4;
  }
  vehicle.steer_angle_max_rad = 0;
  vehicle.slip_angle_max_rad = 45 * kDegree;
  return vehicle;
}

}  // namespace regoplan
