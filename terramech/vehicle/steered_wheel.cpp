#include "terramech/vehicle/steered_wheel.h"

#include <algorithm>

namespace regoplan {

SteeredWheel wheel_on_the_spot(const Vehicle& vehicle, const WheelMount& mount) {
  if (!mount.steered) return {.rim_speed_per_speed = -mount.y_m};
  // Moves along (-y, x); a wheel on the left looks the other way and turns backwards.
  const double x = mount.x_m - vehicle.turn_centre_x_m, y = mount.y_m;
  const double arm = std::sqrt(x * x + y * y);
  const double side = y > 0 ? -1 : 1;
  return {.cos_steer = std::abs(y) / arm,
          .sin_steer = side * x / arm,
          .rim_speed_per_speed = side * arm};
}

namespace {

void share_speed(const Vehicle& vehicle, std::array<SteeredWheel, kMaxWheels>& wheels) {
  double driven = 0;
  const double sum = sum_by_side(vehicle, 0.0, [&](double& of_side, std::size_t i) {
    if (!vehicle.wheels[i].driven) return;
    of_side += wheels[i].rim_speed_per_speed;
    ++driven;
  });
  const double mean = sum / driven;
  for (std::size_t i = 0; i < vehicle.wheels.size(); ++i) {
    if (vehicle.wheels[i].driven) wheels[i].rim_speed_per_speed = mean;
  }
}

}  // namespace

std::array<SteeredWheel, kMaxWheels> steered_wheels(const Vehicle& vehicle,
                                                    const SteeringCommand& command) {
  std::array<SteeredWheel, kMaxWheels> wheels;
  for (std::size_t i = 0; i < vehicle.wheels.size(); ++i) {
    wheels[i] = steered_wheel(vehicle, vehicle.wheels[i], command);
  }
  if (vehicle.drive_law == DriveLaw::kEqualSpeed) share_speed(vehicle, wheels);
  return wheels;
}

std::array<SteeredWheel, kMaxWheels> wheels_on_the_spot(const Vehicle& vehicle) {
  std::array<SteeredWheel, kMaxWheels> wheels;
  for (std::size_t i = 0; i < vehicle.wheels.size(); ++i) {
    wheels[i] = wheel_on_the_spot(vehicle, vehicle.wheels[i]);
  }
  return wheels;
}

bool can_turn_on_the_spot(const Vehicle& vehicle) {
  // One speed or one torque for all wheels turns no vehicle whose sides must turn apart.
  if (vehicle.drive_law != DriveLaw::kKinematic) return false;
  constexpr double kAbreast_m = 1e-6, kRounding_rad = 1e-9;
  return std::ranges::all_of(vehicle.wheels, [&](const WheelMount& mount) {
    if (mount.steered) {
      return std::abs(wheel_on_the_spot(vehicle, mount).steer_rad()) <=
             vehicle.steer_angle_max_rad + kRounding_rad;
    }
    return vehicle.steering == Steering::kSkid ||
           std::abs(mount.x_m - vehicle.turn_centre_x_m) < kAbreast_m;
  });
}

}  // namespace regoplan
