#include "app/settings/vehicle_settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "app/settings/model_settings.h"
#include "app/settings/settings_mapping.h"
#include "app/settings/settings_path.h"
#include "app/settings/soil_settings.h"
#include "terramech/basics/angles.h"
#include "terramech/tables/number_text.h"

namespace regoplan {
namespace {

constexpr ValueRange kAngle{.min = 0, .max = 90, .min_excluded = true};
constexpr ValueRange kSteerAngle{.min = 0, .max = 90};  // 0: skid steering

constexpr std::array<VehicleNumber, 14> kNumbers{{
    {"mass_kg", &Vehicle::mass_kg, 1, kVehicleMass_kg},
    {"yaw_inertia_kgm2", &Vehicle::yaw_inertia_kgm2, 1, kVehicleYawInertia_kgm2},
    {"cg_height_m", &Vehicle::cg_height_m, 1, kAbove0},
    {"turn_centre_x_m", &Vehicle::turn_centre_x_m, 1, kAnyNumber},
    {"speed_max_mps", &Vehicle::speed_max_mps, 1, kVehicleSpeed_mps},
    {"acceleration_max_mps2", &Vehicle::acceleration_max_mps2, 1, kVehicleAcceleration_mps2},
    {"curvature_max_1pm", &Vehicle::curvature_max_1pm, 1, kAbove0},
    {"curvature_rate_max_1pms", &Vehicle::curvature_rate_max_1pms, 1, kAbove0},
    {"steer_angle_max_deg", &Vehicle::steer_angle_max_rad, kDegree, kSteerAngle},
    {"slip_angle_max_deg", &Vehicle::slip_angle_max_rad, kDegree, kAngle},
    {"slip_max", &Vehicle::slip_max, 1, {.min = 0, .max = 1, .min_excluded = true}},
    {"sinkage_max_m", &Vehicle::sinkage_max_m, 1, kAbove0},
    {"slope_max_deg", &Vehicle::slope_max_rad, kDegree, kAngle},
    {"step_max_m", &Vehicle::step_max_m, 1, kAtLeast0},
}};

struct BodyNumber {
  std::string_view key;
  double BodyBox::*member;
  ValueRange allowed;
};

constexpr std::array<BodyNumber, 6> kBodyNumbers{{
    {"x_min_m", &BodyBox::x_min_m, kAnyNumber},
    {"x_max_m", &BodyBox::x_max_m, kAnyNumber},
    {"y_min_m", &BodyBox::y_min_m, kAnyNumber},
    {"y_max_m", &BodyBox::y_max_m, kAnyNumber},
    {"clearance_m", &BodyBox::clearance_m, kAtLeast0},
    {"height_m", &BodyBox::height_m, kAbove0},
}};

// In the order of the enumerations.
const std::vector<std::string>& suspension_names() {
  static const std::vector<std::string> names{"equal_springs", "rocker_bogie"};
  return names;
}

const std::vector<std::string>& drive_law_names() {
  static const std::vector<std::string> names{"kinematic", "equal_torque", "equal_speed"};
  return names;
}

const std::vector<std::string>& steering_names() {
  static const std::vector<std::string> names{"ackermann", "crab", "skid"};
  return names;
}

WheelMount read_wheel_mount(const SettingsNode& node) {
  return read_mapping(node, [](SettingsMapping& mapping) {
    return WheelMount{.name = mapping.required("name").text(),
                      .x_m = mapping.number("x_m", kAnyNumber),
                      .y_m = mapping.number("y_m", kAnyNumber),
                      .steered = mapping.required("steered").truth(),
                      .driven = mapping.required("driven").truth()};
  });
}

BodyBox read_body(const SettingsNode& node) {
  return read_mapping(node, [](SettingsMapping& mapping) {
    BodyBox body;
    for (const BodyNumber& number : kBodyNumbers) {
      body.*number.member = mapping.number(number.key, number.allowed);
    }
    return body;
  });
}

RockerBogie read_rocker_bogie(const SettingsNode& node) {
  return read_mapping(node, [](SettingsMapping& mapping) {
    return RockerBogie{.rocker_pivot_x_m = mapping.number("rocker_pivot_x_m", kAnyNumber),
                       .bogie_pivot_x_m = mapping.number("bogie_pivot_x_m", kAnyNumber)};
  });
}

}  // namespace

std::span<const VehicleNumber> vehicle_numbers() {
  return kNumbers;
}

Vehicle read_vehicle(const SettingsNode& node) {
  return read_mapping(node, [](SettingsMapping& mapping) {
    Vehicle vehicle;
    vehicle.name = mapping.required("name").text();
    vehicle.source = mapping.required("source").text();
    for (const VehicleNumber& number : kNumbers) {
      vehicle.*number.member = mapping.number(number.key, number.allowed) * number.unit;
    }
    vehicle.wheel = read_wheel(mapping.required("wheel"));
    for (const SettingsNode& wheel : mapping.required("wheels").list()) {
      vehicle.wheels.push_back(read_wheel_mount(wheel));
    }
    vehicle.body = read_body(mapping.required("body"));
    if (const SettingsNode* suspension = mapping.optional("suspension")) {
      vehicle.suspension = static_cast<Suspension>(suspension->choice(suspension_names()));
    }
    if (const SettingsNode* pivots = mapping.optional("rocker_bogie")) {
      vehicle.rocker_bogie = read_rocker_bogie(*pivots);
    }
    if (const SettingsNode* law = mapping.optional("drive_law")) {
      vehicle.drive_law = static_cast<DriveLaw>(law->choice(drive_law_names()));
    }
    if (const SettingsNode* steering = mapping.optional("steering")) {
      vehicle.steering = static_cast<Steering>(steering->choice(steering_names()));
    }
    if (const SettingsNode* torque = mapping.optional("torque_max_nm")) {
      vehicle.torque_max_nm = torque->number(kAbove0);
    }
    validate(vehicle);
    return vehicle;
  });
}

Vehicle named_vehicle(const SettingsNode& name, const std::filesystem::path& folder) {
  const std::vector<std::string> presets = preset_vehicle_names();
  if (std::ranges::find(presets, name.text()) != presets.end()) {
    return preset_vehicle(name.text());
  }
  return with_named_file(name, folder, [&](const NamedFile& file) {
    if (!std::filesystem::exists(file.path)) {
      throw name.not_allowed(fmt::format("{}, or a vehicle file; there is no {}",
                                         fmt::join(presets, " | "), file.path.string()));
    }
    try {
      return read_vehicle(read_settings(file.path.string()));
    } catch (const SettingsError& bad) {
      throw SettingsError(fmt::format("{} (read as the vehicle that {}:{} names)", bad.what(),
                                      name.file(), name.line()));
    }
  });
}

std::string vehicle_text(const Vehicle& vehicle) {
  std::string text =
      fmt::format("name: {}\nsource: {}\n", quoted_text(vehicle.name), quoted_text(vehicle.source));
  for (const VehicleNumber& number : kNumbers) {
    text +=
        fmt::format("{}: {}\n", number.key, number_in_unit(vehicle.*number.member, number.unit));
  }
  text += fmt::format("wheel: {{radius_m: {}, width_m: {}}}\nwheels:\n", vehicle.wheel.radius_m,
                      vehicle.wheel.width_m);
  for (const WheelMount& wheel : vehicle.wheels) {
    text += fmt::format("  - {{name: {}, x_m: {}, y_m: {}, steered: {}, driven: {}}}\n",
                        quoted_text(wheel.name), wheel.x_m, wheel.y_m, wheel.steered, wheel.driven);
  }
  text += fmt::format("suspension: {}\n",
                      suspension_names()[static_cast<std::size_t>(vehicle.suspension)]);
  if (vehicle.rocker_bogie) {
    text +=
        fmt::format("rocker_bogie: {{rocker_pivot_x_m: {}, bogie_pivot_x_m: {}}}\n",
                    vehicle.rocker_bogie->rocker_pivot_x_m, vehicle.rocker_bogie->bogie_pivot_x_m);
  }
  text += fmt::format("drive_law: {}\nsteering: {}\n",
                      drive_law_names()[static_cast<std::size_t>(vehicle.drive_law)],
                      steering_names()[static_cast<std::size_t>(vehicle.steering)]);
  if (vehicle.torque_max_nm) text += fmt::format("torque_max_nm: {}\n", *vehicle.torque_max_nm);
  text += "body:\n";
  for (const BodyNumber& number : kBodyNumbers) {
    text += fmt::format("  {}: {}\n", number.key, vehicle.body.*number.member);
  }
  return text;
}

}  // namespace regoplan
