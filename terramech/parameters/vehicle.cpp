#include "terramech/parameters/vehicle.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "terramech/basics/angles.h"
#include "terramech/basics/input_error.h"
#include "terramech/parameters/ground_patch.h"
#include "terramech/parameters/trusted_range.h"

namespace regoplan {
namespace {

constexpr double kSteerReserve_rad = 1 * kDegree;
constexpr double kLongest_m = 100;
/// Below this, two positions are the same: files give millimetres.
constexpr double kSamePlace_m = 1e-6;

void require_between(const std::string& field, double value, double min, double max) {
  if (!(value >= min && value <= max)) {
    throw ValueError(field, value, fmt::format("{} to {}", min, max));
  }
}

void require_above(const std::string& field, double value, double min, double max) {
  if (!(value > min && value <= max)) {
    throw ValueError(field, value, fmt::format("above {} to {}", min, max));
  }
}

double cross(const WheelMount& origin, const WheelMount& a, const WheelMount& b) {
  return (a.x_m - origin.x_m) * (b.y_m - origin.y_m) - (a.y_m - origin.y_m) * (b.x_m - origin.x_m);
}

bool all_on_a_line(const std::vector<WheelMount>& wheels) {
  for (const WheelMount& a : wheels) {
    for (const WheelMount& b : wheels) {
      if (std::abs(cross(wheels.front(), a, b)) > kSamePlace_m) return false;
    }
  }
  return true;
}

/// The origin is outside when some line through two wheels has it on one side, alone.
bool origin_within_contacts(const std::vector<WheelMount>& wheels) {
  const WheelMount origin;
  for (const WheelMount& a : wheels) {
    for (const WheelMount& b : wheels) {
      if (std::hypot(a.x_m - b.x_m, a.y_m - b.y_m) < kSamePlace_m) continue;
      const bool all_left = std::all_of(wheels.begin(), wheels.end(), [&](const WheelMount& w) {
        return cross(a, b, w) >= -kSamePlace_m;
      });
      if (all_left && cross(a, b, origin) <= kSamePlace_m) return false;
    }
  }
  return true;
}

void validate_wheels(const std::vector<WheelMount>& wheels) {
  if (wheels.size() < 3 || wheels.size() > kMaxWheels) {
    throw ValueError("wheels", double(wheels.size()), fmt::format("3 to {} wheels", kMaxWheels));
  }
  for (const WheelMount& wheel : wheels) {
    if (wheel.name.empty()) throw InputError("wheels: a wheel has no name");
    require_between(fmt::format("wheels.{}.x_m", wheel.name), wheel.x_m, -kLongest_m, kLongest_m);
    require_between(fmt::format("wheels.{}.y_m", wheel.name), wheel.y_m, -kLongest_m, kLongest_m);
    const auto same_name = std::count_if(wheels.begin(), wheels.end(),
                                         [&](const WheelMount& w) { return w.name == wheel.name; });
    if (same_name > 1) {
      throw InputError(fmt::format("wheels: {} wheels are named '{}'", same_name, wheel.name));
    }
  }
  if (all_on_a_line(wheels)) throw InputError("wheels: they stand on one line and carry nothing");
  if (!origin_within_contacts(wheels)) {
    throw InputError(
        "wheels: the centre of gravity (x_m = y_m = 0) is not inside the polygon of their "
        "contacts");
  }
  if (std::none_of(wheels.begin(), wheels.end(), [](const WheelMount& w) { return w.driven; })) {
    throw InputError("wheels: none is driven");
  }
}

/// Whether a wheel has room to steer against slip beside its angle at a curvature, either side.
bool has_room_to_steer(const Vehicle& vehicle, const WheelMount& wheel, double curvature_1pm) {
  return std::ranges::all_of(std::array{-1.0, 1.0}, [&](double side) {
    return std::abs(steer_angle_rad(vehicle, wheel, side * curvature_1pm)) + kSteerReserve_rad <=
           vehicle.steer_angle_max_rad;
  });
}

void validate_steering(const Vehicle& vehicle) {
  require_above("curvature_max_1pm", vehicle.curvature_max_1pm, 0, 100);
  require_above("curvature_rate_max_1pms", vehicle.curvature_rate_max_1pms, 0, 1000);
  require_between("turn_centre_x_m", vehicle.turn_centre_x_m, -kLongest_m, kLongest_m);
  if (std::abs(vehicle.curvature_max_1pm * vehicle.turn_centre_x_m) >= 1) {
    throw ValueError(
        "curvature_max_1pm", vehicle.curvature_max_1pm,
        fmt::format("below 1/|turn_centre_x_m| = {:.6g}", 1 / std::abs(vehicle.turn_centre_x_m)));
  }
  const auto steered = [](const WheelMount& w) { return w.steered; };
  const bool steers = std::ranges::any_of(vehicle.wheels, steered);
  if (vehicle.steering == Steering::kSkid) {
    if (steers) throw InputError("steering: skid, but a wheel is steered");
    if (vehicle.drive_law != DriveLaw::kKinematic) {
      throw InputError(
          "drive_law: not kinematic, but steering is skid: rims of one speed or one "
          "torque cannot steer");
    }
  } else if (!steers) {
    throw InputError("steering: no wheel is steered; vehicles without say steering: skid");
  }
  if (vehicle.steering == Steering::kCrab && !std::ranges::all_of(vehicle.wheels, steered)) {
    throw InputError("steering: crab, but not every wheel is steered");
  }
  require_between("steer_angle_max_deg", rounded_degrees(vehicle.steer_angle_max_rad), 0, 89);
  if (steers && vehicle.steer_angle_max_rad == 0) {
    throw ValueError("steer_angle_max_deg", 0, "above 0 to 89 where a wheel is steered");
  }
  for (const WheelMount& wheel : vehicle.wheels) {
    if (!wheel.steered) continue;
    if (vehicle.steering != Steering::kCrab &&
        std::abs(wheel.x_m - vehicle.turn_centre_x_m) < kSamePlace_m) {
      throw ValueError(
          fmt::format("wheels.{}.x_m", wheel.name), wheel.x_m,
          fmt::format("off turn_centre_x_m = {:.6g}: there a steered wheel never turns",
                      vehicle.turn_centre_x_m));
    }
    if (!has_room_to_steer(vehicle, wheel, vehicle.curvature_max_1pm)) {
      const double angle_rad =
          std::max(std::abs(steer_angle_rad(vehicle, wheel, vehicle.curvature_max_1pm)),
                   std::abs(steer_angle_rad(vehicle, wheel, -vehicle.curvature_max_1pm)));
      throw ValueError(
          "curvature_max_1pm", vehicle.curvature_max_1pm,
          fmt::format("what keeps every wheel 1 deg within steer_angle_max_deg = {:.6g}; wheel "
                      "'{}' would need {:.4g} deg",
                      rounded_degrees(vehicle.steer_angle_max_rad), wheel.name,
                      rounded_degrees(angle_rad)));
    }
  }
}

/// The x of the three axles, front first.
std::array<double, 3> axles_of_six_wheels(std::vector<WheelMount> wheels) {
  if (wheels.size() != 6) {
    throw ValueError("wheels", double(wheels.size()), "6 wheels for suspension rocker_bogie");
  }
  std::sort(wheels.begin(), wheels.end(),
            [](const WheelMount& a, const WheelMount& b) { return a.x_m > b.x_m; });
  std::array<double, 3> axle_x_m{};
  for (std::size_t axle = 0; axle < 3; ++axle) {
    const WheelMount& a = wheels[2 * axle];
    const WheelMount& b = wheels[2 * axle + 1];
    const bool a_pair = std::abs(a.x_m - b.x_m) < kSamePlace_m && a.y_m * b.y_m < 0;
    if (!a_pair) {
      throw InputError(
          fmt::format("wheels: '{}' and '{}' are not the left and right wheel of one "
                      "axle, as suspension rocker_bogie needs",
                      a.name, b.name));
    }
    axle_x_m[axle] = a.x_m;
  }
  return axle_x_m;
}

void validate_suspension(const Vehicle& vehicle) {
  if (vehicle.suspension != Suspension::kRockerBogie) {
    if (vehicle.rocker_bogie) {
      throw InputError("rocker_bogie: given, but suspension is not rocker_bogie");
    }
    return;
  }
  if (!vehicle.rocker_bogie) {
    throw InputError("rocker_bogie: missing, and suspension is rocker_bogie");
  }
  const auto [front_x_m, middle_x_m, rear_x_m] = axles_of_six_wheels(vehicle.wheels);
  const RockerBogie& pivots = *vehicle.rocker_bogie;
  const auto require_inside = [](const char* field, double value, double low, double high) {
    if (!(value > low && value < high)) {
      throw ValueError(field, value, fmt::format("between {:.6g} and {:.6g}", low, high));
    }
  };
  require_inside("rocker_bogie.bogie_pivot_x_m", pivots.bogie_pivot_x_m, rear_x_m, middle_x_m);
  require_inside("rocker_bogie.rocker_pivot_x_m", pivots.rocker_pivot_x_m, pivots.bogie_pivot_x_m,
                 front_x_m);
  if (!(pivots.bogie_pivot_x_m < 0 && front_x_m > 0)) {
    throw ValueError("rocker_bogie.bogie_pivot_x_m", pivots.bogie_pivot_x_m,
                     "behind the centre of gravity (x_m = 0): else the front wheels carry nothing");
  }
}

void validate_body(const BodyBox& body) {
  for (const auto& [field, value] :
       {std::pair{"body.x_min_m", body.x_min_m}, std::pair{"body.x_max_m", body.x_max_m},
        std::pair{"body.y_min_m", body.y_min_m}, std::pair{"body.y_max_m", body.y_max_m}}) {
    require_between(field, value, -kLongest_m, kLongest_m);
  }
  if (!(body.x_min_m < body.x_max_m)) {
    throw ValueError("body.x_max_m", body.x_max_m, fmt::format("above x_min_m {}", body.x_min_m));
  }
  if (!(body.y_min_m < body.y_max_m)) {
    throw ValueError("body.y_max_m", body.y_max_m, fmt::format("above y_min_m {}", body.y_min_m));
  }
  require_above("body.clearance_m", body.clearance_m, 0, kLongest_m);
  require_above("body.height_m", body.height_m, 0, kLongest_m);
}

}  // namespace

double steerable_curvature_1pm(const Vehicle& vehicle) {
  const auto can_steer = [&vehicle](double curvature_1pm) {
    if (std::abs(curvature_1pm * vehicle.turn_centre_x_m) >= 1) return false;
    return std::ranges::all_of(vehicle.wheels, [&](const WheelMount& wheel) {
      return !wheel.steered || has_room_to_steer(vehicle, wheel, curvature_1pm);
    });
  };
  if (can_steer(vehicle.curvature_max_1pm)) return vehicle.curvature_max_1pm;
  double can = 0, cannot = vehicle.curvature_max_1pm;
  while (cannot - can > 1e-9 * vehicle.curvature_max_1pm) {
    const double middle = (can + cannot) / 2;
    (can_steer(middle) ? can : cannot) = middle;
  }
  return can;
}

bool stands_on_wheels(const Vehicle& vehicle) {
  return origin_within_contacts(vehicle.wheels);
}

Vehicle with_centre_moved(Vehicle vehicle, double forward_m, double left_m, double up_m) {
  vehicle.cg_height_m += up_m;
  vehicle.turn_centre_x_m -= forward_m;
  for (WheelMount& wheel : vehicle.wheels) {
    wheel.x_m -= forward_m;
    wheel.y_m -= left_m;
  }
  if (vehicle.rocker_bogie) {
    vehicle.rocker_bogie->rocker_pivot_x_m -= forward_m;
    vehicle.rocker_bogie->bogie_pivot_x_m -= forward_m;
  }
  vehicle.body.x_min_m -= forward_m;
  vehicle.body.x_max_m -= forward_m;
  vehicle.body.y_min_m -= left_m;
  vehicle.body.y_max_m -= left_m;
  return vehicle;
}

double steer_angle_rad(const Vehicle& vehicle, const WheelMount& wheel, double curvature_1pm) {
  if (!wheel.steered) return 0;
  const double x_c = vehicle.turn_centre_x_m;
  const double k = curvature_1pm;
  return std::atan2(k * (wheel.x_m - x_c), std::sqrt(1 - (k * x_c) * (k * x_c)) - k * wheel.y_m);
}

double kinematic_body_slip_angle_rad(const Vehicle& vehicle, double curvature_1pm) {
  return std::asin(-curvature_1pm * vehicle.turn_centre_x_m);
}

double longest_arm_m(const Vehicle& vehicle) {
  double longest = 0;
  for (const WheelMount& mount : vehicle.wheels) {
    longest = std::max(longest, std::hypot(mount.x_m, mount.y_m));
  }
  return longest;
}

void validate(const Vehicle& vehicle) {
  if (vehicle.name.empty()) throw InputError("name: the vehicle has none");
  require("mass_kg", vehicle.mass_kg, kVehicleMass_kg);
  require("yaw_inertia_kgm2", vehicle.yaw_inertia_kgm2, kVehicleYawInertia_kgm2);
  require_above("cg_height_m", vehicle.cg_height_m, 0, kLongest_m);
  try {
    validate(vehicle.wheel);
  } catch (const ValueError& error) {
    throw ValueError("wheel." + error.field(), error.value(), error.allowed());
  }
  validate_wheels(vehicle.wheels);
  validate_suspension(vehicle);
  validate_body(vehicle.body);
  require("speed_max_mps", vehicle.speed_max_mps, kVehicleSpeed_mps);
  require("acceleration_max_mps2", vehicle.acceleration_max_mps2, kVehicleAcceleration_mps2);
  if (vehicle.torque_max_nm) require_above("torque_max_nm", *vehicle.torque_max_nm, 0, 1e6);
  validate_steering(vehicle);
  require_above("slip_angle_max_deg", rounded_degrees(vehicle.slip_angle_max_rad), 0,
                rounded_degrees(kTrustedSlipAngle_rad));
  require_above("slip_max", vehicle.slip_max, 0, kTrustedSlip_max);
  require_above("sinkage_max_m", vehicle.sinkage_max_m, 0, vehicle.wheel.radius_m);
  require_above("slope_max_deg", rounded_degrees(vehicle.slope_max_rad), 0, 60);
  require_between("step_max_m", vehicle.step_max_m, 0, vehicle.body.clearance_m);
}

}  // namespace regoplan
