#include "drive_diagnosis/comparison/vehicle_trials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "terramech/basics/angles.h"

namespace regoplan {
namespace {

/// Collects trials; a trial's size is what a sound vehicle is off.
class Trials {
 public:
  template <class Set>
  void add(std::string id, std::string parameter, double unit, const Set& set) {
    VehicleTrial trial{std::move(id), std::move(parameter), unit, {}, {}};
    set(trial.deviation, unit);
    trials.push_back(std::move(trial));
  }
  void add(std::string id, std::string parameter, double unit, double VehicleDeviation::*of) {
    add(std::move(id), std::move(parameter), unit,
        [of](VehicleDeviation& d, double size) { d.*of = size; });
  }
  std::vector<VehicleTrial> trials;
};

/// How far a number may be off, as a share of it.
double share_or(const std::optional<DriveEstimate>& number, double sound) {
  return number ? number->std / number->value : sound;
}

constexpr double kSoundSteer_deg = 0.1, kSoundMotor = 0.01;
/// Of all wheels, and of one of them beside the others.
constexpr double kSoundRadius = 0.003, kSoundRadiusOfOne = 0.001;
/// Of torque over radius and of pull, per share of load, as a share of the load.
constexpr double kSoundLaw = 0.003;
/// Of all torques: a law whose rise with the load is right has them right as well. Beside one that
/// is claimed they are free to 200 times as much (`kClaimedFault`), a tenth.
constexpr double kSoundLawTorque = 0.0005;
/// Cells smooth what wheels stand on.
constexpr double kSoundHeights = 0.005;
/// Wheels that sink deeper downhill tilt a vehicle more than the ground, by 2 to 4 %.
constexpr double kSoundTilt = 0.03;
/// By how much the times of sensors of one recording differ.
constexpr double kSoundLate_s = 0.03;

/// What grows with a vehicle: bearings and gears with what they carry, where parts sit with its
/// length. Shares are told by a lunar rover of 700 kg: 0.2 N m on wheels of 0.409 m, 3 N, and 1.5
/// and 2.5 cm on a wheelbase of 2.286 m.
struct SoundSizes {
  double drag_nm = 0, tow_n = 0, cg_m = 0, cg_up_m = 0;
};

SoundSizes sound_sizes(const Vehicle& vehicle, double gravity_mps2) {
  constexpr double kWeight_n = 700 * 1.62, kRadius_m = 0.409, kWheelbase_m = 2.286;
  const auto [rear, front] = std::ranges::minmax(vehicle.wheels, {}, &WheelMount::x_m);
  const double heavier = vehicle.mass_kg * gravity_mps2 / kWeight_n;
  const double longer = (front.x_m - rear.x_m) / kWheelbase_m;
  return {.drag_nm = 0.2 * heavier * (vehicle.wheel.radius_m / kRadius_m),
          .tow_n = 3 * heavier,
          .cg_m = 0.015 * longer,
          .cg_up_m = 0.025 * longer};
}

void add_wheels(const Vehicle& vehicle, double drag_nm, Trials& trials) {
  for (std::size_t i = 0; i < vehicle.wheels.size(); ++i) {
    const WheelMount& mount = vehicle.wheels[i];
    trials.add("wheel_drag", "drag_" + mount.name + "_nm", drag_nm,
               [i](VehicleDeviation& d, double size) { d.wheel_drag_nm.at(i) = size; });
    trials.add("motor_constant", "torque_" + mount.name + "_share", kSoundMotor,
               [i](VehicleDeviation& d, double size) { d.motor_share.at(i) = size; });
    trials.add("wheel_radius", "radius_" + mount.name + "_share", kSoundRadiusOfOne,
               [i](VehicleDeviation& d, double size) { d.wheel_radius_share.at(i) = size; });
    trials.add("clock_offset", "wheel_speed_" + mount.name + "_late_s", kSoundLate_s,
               [i](VehicleDeviation& d, double size) { d.wheel_speed_late_s.at(i) = size; });
    // Where no wheel is steered, one that is mounted askew looks like a drag of its side; beside
    // steered wheels none is sought, which `say_what_is_silent` tells.
    if (!mount.steered && vehicle.steering != Steering::kSkid) continue;
    trials.add(
        "steering_offset", "steer_" + mount.name + "_deg", kSoundSteer_deg,
        [i](VehicleDeviation& d, double size) { d.steering_offset_rad.at(i) = size * kDegree; });
  }
}

void add_pairs(const Vehicle& vehicle, double drag_nm, Trials& trials) {
  const auto [rear, front] = std::ranges::minmax(vehicle.wheels, {}, &WheelMount::x_m);
  for (const auto& [name, x_m] : {std::pair{"front", front.x_m}, {"rear", rear.x_m}}) {
    std::vector<std::size_t> pair;
    for (std::size_t i = 0; i < vehicle.wheels.size(); ++i) {
      const bool there = std::abs(vehicle.wheels[i].x_m - x_m) < 0.1;
      if (there && vehicle.wheels[i].steered) pair.push_back(i);
    }
    if (pair.size() < 2) continue;
    trials.add("steering_offset", fmt::format("steer_{}_deg", name), kSoundSteer_deg,
               [&pair](VehicleDeviation& d, double size) {
                 for (const std::size_t i : pair) d.steering_offset_rad.at(i) = size * kDegree;
               });
  }
  for (const bool left : {true, false}) {
    trials.add("side_drag", left ? "drag_left_nm" : "drag_right_nm", drag_nm,
               [&](VehicleDeviation& d, double size) {
                 for (std::size_t i = 0; i < vehicle.wheels.size(); ++i) {
                   if ((vehicle.wheels[i].y_m > 0) == left) d.wheel_drag_nm.at(i) = size;
                 }
               });
  }
}

}  // namespace

std::vector<VehicleTrial> vehicle_trials(const Vehicle& vehicle, double gravity_mps2,
                                         const UncertainVehicle& uncertain, const TerrainMap& map,
                                         const std::vector<bool>& soils, bool attitude_follows) {
  const SoundSizes sound = sound_sizes(vehicle, gravity_mps2);
  Trials trials;
  add_wheels(vehicle, sound.drag_nm, trials);
  add_pairs(vehicle, sound.drag_nm, trials);
  trials.add("motor_constant", "torque_share", share_or(uncertain.motor_constant, kSoundMotor),
             [](VehicleDeviation& d, double size) { d.motor_share.fill(size); });
  trials.add("wheel_radius", "radius_share", share_or(uncertain.wheel_radius_m, kSoundRadius),
             &VehicleDeviation::radius_share);
  trials.add("clock_offset", "wheel_speeds_late_s", kSoundLate_s,
             [](VehicleDeviation& d, double size) { d.wheel_speed_late_s.fill(size); });
  trials.add("clock_offset", "attitude_late_s", kSoundLate_s, &VehicleDeviation::attitude_late_s);
  trials.add("payload", "mass_share", share_or(uncertain.mass_kg, 0.015),
             &VehicleDeviation::payload_share);
  trials.add("cg_offset", "forward_m", sound.cg_m, &VehicleDeviation::cg_forward_m);
  trials.add("cg_offset", "left_m", sound.cg_m, &VehicleDeviation::cg_left_m);
  trials.add("cg_offset", "up_m", sound.cg_up_m, &VehicleDeviation::cg_up_m);
  trials.add("tow_drag", "drag_n", sound.tow_n, &VehicleDeviation::tow_drag_n);
  // Model and wheel part soonest in how forces rise with the load, which no number of a soil gives.
  trials.add("wheel_law", "torque_by_load", kSoundLaw, &VehicleDeviation::torque_by_load);
  trials.add("wheel_law", "pull_by_load", kSoundLaw, &VehicleDeviation::pull_by_load);
  trials.add("", "law_torque_share", kSoundLawTorque,
             [](VehicleDeviation& d, double size) { d.motor_share.fill(size); });
  trials.trials.back().beside = "wheel_law";
  trials.add("map_offset", "east_m", 0.2, &VehicleDeviation::map_east_m);
  trials.add("map_offset", "north_m", 0.2, &VehicleDeviation::map_north_m);
  if (attitude_follows) {
    trials.add("map_heights", "height_share", kSoundHeights, &VehicleDeviation::map_height_share);
    trials.add("", "tilt_share", kSoundTilt, &VehicleDeviation::tilt_share);
  }
  if (std::ranges::count(soils, true) > 1) {
    trials.add("zone_border", "east_m", 0.5, &VehicleDeviation::soil_east_m);
    trials.add("zone_border", "north_m", 0.5, &VehicleDeviation::soil_north_m);
  }
  // How the sensors sit is estimated, and judged elsewhere.
  trials.add("", "pitch_rad", 0.05, &VehicleDeviation::mounting_pitch_rad);
  trials.add("", "roll_rad", 0.05, &VehicleDeviation::mounting_roll_rad);
  trials.add("", "yaw_rad", 0.005, &VehicleDeviation::mounting_yaw_rad);
  for (std::size_t soil = 0; soil < map.soils().size(); ++soil) {
    if (!soils[soil]) continue;
    const SoilNumbers spread = told_spread(map.soils()[soil].soil);
    for (std::size_t k = 0; k < kSoilNumbers; ++k) {
      if (!(spread.at(k) > 0)) continue;
      trials.add("", map.soils()[soil].name + "." + std::string(soil_parameters().at(k).name), 1,
                 [&](VehicleDeviation& d, double size) {
                   d.soils.resize(map.soils().size());
                   d.soils[soil].at(k) = size;
                 });
    }
  }
  return trials.trials;
}

UncertainVehicle estimated_vehicle(const UncertainVehicle& said,
                                   const std::vector<VehicleTrial>& trials,
                                   const Eigen::VectorXd& sizes, const Eigen::VectorXd& stds) {
  const auto estimate = [&](const std::optional<DriveEstimate>& number, std::string_view parameter,
                            int power) -> std::optional<DriveEstimate> {
    if (!number) return {};
    const auto trial = std::ranges::find(trials, parameter, &VehicleTrial::parameter);
    const auto k = static_cast<Eigen::Index>(trial - trials.begin());
    const double value = number->value * std::pow(1 + sizes[k] * trial->unit, power);
    return DriveEstimate{value, value * stds[k] * trial->unit};
  };
  return {.mass_kg = estimate(said.mass_kg, "mass_share", 1),
          .wheel_radius_m = estimate(said.wheel_radius_m, "radius_share", 1),
          // What is told too large by a share is to be multiplied by less.
          .motor_constant = estimate(said.motor_constant, "torque_share", -1)};
}

std::vector<SoilNumbers> soil_stds(const std::vector<VehicleTrial>& trials,
                                   const Eigen::VectorXd& stds, std::size_t soils) {
  SoilNumbers one{};
  one.fill(1);
  std::vector<SoilNumbers> left(soils, one);
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const std::vector<SoilNumbers>& of = trials[i].deviation.soils;
    for (std::size_t soil = 0; soil < of.size(); ++soil) {
      for (std::size_t k = 0; k < kSoilNumbers; ++k) {
        if (of[soil].at(k) != 0) left[soil].at(k) = stds[static_cast<Eigen::Index>(i)];
      }
    }
  }
  return left;
}

std::vector<std::size_t> trials_of_soil(const std::vector<VehicleTrial>& trials, std::size_t soil) {
  std::vector<std::size_t> of_soil;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const std::vector<SoilNumbers>& of = trials[i].deviation.soils;
    if (soil < of.size() && of[soil] != SoilNumbers{}) of_soil.push_back(i);
  }
  return of_soil;
}

}  // namespace regoplan
