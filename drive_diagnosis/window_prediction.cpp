#include "drive_diagnosis/window_prediction.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "terramech/basics/input_error.h"
#include "terramech/vehicle/steered_wheel.h"
#include "terramech/vehicle/wheel_loads.h"
#include "terramech/wheel/wheel_model.h"

namespace regoplan {
namespace {

using Soils = std::array<std::int16_t, kMaxWheels>;

/// The ground of a window: the mean of its places, and which soils its wheels stand on, how often.
struct WindowGround {
  GroundPatch mean;
  std::vector<std::pair<Soils, double>> soils;  ///< with their shares
};

/// A vehicle in a window, with its deviation worked in.
struct Scene {
  Vehicle vehicle;
  LoadSharing sharing;
  PatchAxes axes;
  double hollow_1pm = 0;
  std::vector<WheelModel> models;  ///< of each wheel
  std::array<SteeredWheel, kMaxWheels> wheels{};
  std::array<double, kMaxWheels> rim_mps{};
};

Vehicle deviating(Vehicle vehicle, const VehicleDeviation& deviation) {
  vehicle.mass_kg *= 1 + deviation.payload_share;
  vehicle.cg_height_m += deviation.cg_up_m;
  for (WheelMount& mount : vehicle.wheels) {
    mount.x_m -= deviation.cg_forward_m;
    mount.y_m -= deviation.cg_left_m;
  }
  return vehicle;
}

Soils soils_under(const TerrainMap& map, const Vehicle& vehicle, const WindowInput::Place& place,
                  const Soils& otherwise) {
  Soils soils = otherwise;
  const double c = std::cos(place.yaw_rad), s = std::sin(place.yaw_rad);
  for (std::size_t i = 0; i < vehicle.wheels.size(); ++i) {
    const WheelMount& wheel = vehicle.wheels[i];
    const auto soil = map.soil_index(place.x_m + c * wheel.x_m - s * wheel.y_m,
                                     place.y_m + s * wheel.x_m + c * wheel.y_m);
    if (soil) soils.at(i) = static_cast<std::int16_t>(*soil);
  }
  return soils;
}

std::optional<WindowGround> ground_of(const GroundFinder& finder, const TerrainMap& map,
                                      const Vehicle& vehicle, const WindowInput& input,
                                      const VehicleDeviation& deviation) {
  WindowGround ground;
  const bool borders_lie_off = deviation.soil_east_m != 0 || deviation.soil_north_m != 0;
  constexpr double kShare = 1.0 / WindowInput::kPlaces;
  for (WindowInput::Place place : input.places) {
    place.x_m -= deviation.map_east_m;
    place.y_m -= deviation.map_north_m;
    place.yaw_rad -= deviation.mounting_yaw_rad;
    GroundPatch patch = finder.at(place.x_m, place.y_m, place.yaw_rad);
    if (!patch.known) return {};
    if (borders_lie_off) {
      place.x_m -= deviation.soil_east_m;
      place.y_m -= deviation.soil_north_m;
      patch.soil = soils_under(map, vehicle, place, patch.soil);
    }
    ground.mean.slope_forward += kShare * patch.slope_forward;
    ground.mean.slope_left += kShare * patch.slope_left;
    ground.mean.curvature_1pm += kShare * patch.curvature_1pm;
    const auto same =
        std::ranges::find(ground.soils, patch.soil, [](const auto& s) { return s.first; });
    if (same == ground.soils.end()) {
      ground.soils.emplace_back(patch.soil, kShare);
    } else {
      same->second += kShare;
    }
  }
  return ground;
}

SoilNumbers numbers_at(const VehicleDeviation& deviation, std::size_t soil,
                       const SoilNumbers& zone) {
  SoilNumbers numbers = zone;
  if (deviation.soils.empty()) return numbers;
  for (std::size_t k = 0; k < kSoilNumbers; ++k) numbers.at(k) += deviation.soils[soil].at(k);
  return numbers;
}

/// Forces on the body at a motion, with the loads that a given total force leads to.
struct Sums {
  BodyForce force;
  std::array<double, kMaxWheels> torque_nm{};
  bool carried = true;
};

Sums sums_at(const Scene& scene, const BodyMotion& motion, const GroundReaction& reaction) {
  Sums sums;
  for (std::size_t i = 0; i < scene.vehicle.wheels.size(); ++i) {
    const double load_n = scene.sharing.load_n(i, reaction);
    if (!(load_n > 0)) {
      sums.carried = false;
      continue;
    }
    const WheelMount& mount = scene.vehicle.wheels[i];
    const WheelForces forces = scene.models[i].forces(
        load_n, wheel_motion(mount, scene.wheels.at(i), motion, scene.rim_mps.at(i)));
    if (!has_forces(forces.status)) sums.carried = false;
    sums.force.add(mount, scene.wheels.at(i), forces);
    sums.torque_nm.at(i) = forces.torque_nm;
  }
  return sums;
}

using Vector = Eigen::Vector3d;

BodyMotion motion_of(const Vector& v) {
  return {.vx_mps = v[0], .vy_mps = v[1], .yaw_rate_rad_s = v[2]};
}

GroundReaction reaction_at(const Scene& scene, const WindowInput& input, const Vector& v) {
  const double m = scene.vehicle.mass_kg;
  return {
      .normal_n = m * (scene.axes.gravity_normal_mps2 + v[0] * v[0] * scene.hollow_1pm),
      .forward_n = m * (input.acceleration_mps2 - v[1] * v[2] - scene.axes.gravity_forward_mps2),
      .left_n = m * (v[0] * v[2] - scene.axes.gravity_left_mps2)};
}

/// What is left over of forces and moment at a motion, in units of the weight.
Vector imbalance(const Scene& scene, const WindowInput& input, double tow_drag_n, const Vector& v) {
  const GroundReaction needed = reaction_at(scene, input, v);
  const BodyForce force = sums_at(scene, motion_of(v), needed).force;
  const double weight_n = scene.vehicle.mass_kg * scene.axes.gravity_normal_mps2;
  const double turning = scene.vehicle.yaw_inertia_kgm2 * input.yaw_acceleration_rps2;
  return Vector{force.forward_n - tow_drag_n - needed.forward_n, force.left_n - needed.left_n,
                force.yaw_nm - turning} /
         weight_n;
}

/// Newton's method with slopes by differences, its steps kept short.
std::optional<Vector> balanced(const Scene& scene, const WindowInput& input, double tow_drag_n) {
  Vector v{input.speed_mps, 0, input.yaw_rate_rad_s};
  constexpr int kSteps = 25;
  for (int step = 0; step < kSteps; ++step) {
    const Vector here = imbalance(scene, input, tow_drag_n, v);
    Eigen::Matrix3d slopes;
    const double h = 1e-5 * std::max(std::abs(v[0]), 0.05);
    for (int k = 0; k < 3; ++k) {
      Vector moved = v;
      moved[k] += h;
      slopes.col(k) = (imbalance(scene, input, tow_drag_n, moved) - here) / h;
    }
    Vector change = -slopes.fullPivLu().solve(here);
    const double reach = 0.2 * std::max(std::abs(v[0]), 0.05);
    const double largest = change.cwiseAbs().maxCoeff();
    if (!std::isfinite(largest)) return {};
    if (largest > reach) change *= reach / largest;
    v += change;
    constexpr double kClose = 1e-6;
    if (largest < kClose) return v;
  }
  return {};
}

bool is_valid(const Soil& soil) {
  try {
    validate(soil);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace

SoilNumbers soil_spread(const UncertainSoil& soil) {
  SoilNumbers spread{};
  bool any = false;
  const auto& parameters = soil_parameters();
  for (std::size_t k = 0; k < kSoilNumbers; ++k) {
    spread.at(k) = soil.standard_deviation.*parameters.at(k).member;
    any = any || spread.at(k) > 0;
  }
  if (any) return spread;
  for (std::size_t k = 0; k < kSoilNumbers; ++k) {
    double Soil::*const member = parameters.at(k).member;
    const bool counts = member == &Soil::cohesion_pa || member == &Soil::friction_angle_rad ||
                        member == &Soil::kc || member == &Soil::kphi;
    if (counts) spread.at(k) = 0.1 * std::abs(soil.mean.*member);
  }
  return spread;
}

Soil deviating(const UncertainSoil& soil, const SoilNumbers& deviations) {
  const SoilNumbers spread = soil_spread(soil);
  const auto& parameters = soil_parameters();
  for (double share = 1; share > 0.01; share *= 0.7) {  // short of what no soil is
    Soil result = soil.mean;
    for (std::size_t k = 0; k < kSoilNumbers; ++k) {
      double& value = result.*parameters.at(k).member;
      const double off = share * deviations.at(k) * spread.at(k);
      if (off == 0) continue;
      value = value > 0 ? value * std::exp(off / value) : value + off;
    }
    if (is_valid(result)) return result;
  }
  return soil.mean;
}

SoilNumbers deviations_between(const UncertainSoil& soil, const Soil& other) {
  const SoilNumbers spread = soil_spread(soil);
  SoilNumbers numbers{};
  for (std::size_t k = 0; k < kSoilNumbers; ++k) {
    if (!(spread.at(k) > 0)) continue;
    double Soil::*const member = soil_parameters().at(k).member;
    const double from = soil.mean.*member, to = other.*member;
    numbers.at(k) = (from > 0 && to > 0 ? from * std::log(to / from) : to - from) / spread.at(k);
  }
  return numbers;
}

SoilNumbers weaker_by(double deviations) {
  SoilNumbers numbers{};
  for (std::size_t k = 0; k < kSoilNumbers; ++k) {
    double Soil::*const member = soil_parameters().at(k).member;
    const bool counts = member == &Soil::cohesion_pa || member == &Soil::friction_angle_rad ||
                        member == &Soil::kc || member == &Soil::kphi;
    if (counts) numbers.at(k) = -deviations;
  }
  return numbers;
}

Soil weaker(const UncertainSoil& soil, double deviations) {
  return deviating(soil, weaker_by(deviations));
}

void VehicleDeviation::add(const VehicleDeviation& other, double times) {
  for (std::size_t i = 0; i < kMaxWheels; ++i) {
    wheel_drag_nm.at(i) += times * other.wheel_drag_nm.at(i);
    steering_offset_rad.at(i) += times * other.steering_offset_rad.at(i);
    motor_share.at(i) += times * other.motor_share.at(i);
  }
  for (double VehicleDeviation::*of :
       {&VehicleDeviation::radius_share, &VehicleDeviation::payload_share,
        &VehicleDeviation::cg_forward_m, &VehicleDeviation::cg_left_m, &VehicleDeviation::cg_up_m,
        &VehicleDeviation::tow_drag_n, &VehicleDeviation::map_east_m,
        &VehicleDeviation::map_north_m, &VehicleDeviation::soil_east_m,
        &VehicleDeviation::soil_north_m, &VehicleDeviation::mounting_pitch_rad,
        &VehicleDeviation::mounting_roll_rad, &VehicleDeviation::mounting_yaw_rad}) {
    this->*of += times * (other.*of);
  }
  if (soils.size() < other.soils.size()) soils.resize(other.soils.size());
  for (std::size_t i = 0; i < other.soils.size(); ++i) {
    for (std::size_t k = 0; k < kSoilNumbers; ++k) {
      soils[i].at(k) += times * other.soils[i].at(k);
    }
  }
}

WindowModel::WindowModel(const TerrainMap& map, const Vehicle& vehicle, double gravity_mps2)
    : map_(map), vehicle_(vehicle), ground_(map, vehicle), gravity_mps2_(gravity_mps2) {}

std::optional<WindowPrediction> WindowModel::predict(const WindowInput& input,
                                                     const VehicleDeviation& deviation,
                                                     const SoilNumbers& zone) const {
  const auto ground = ground_of(ground_, map_, vehicle_, input, deviation);
  if (!ground) return {};
  const Vehicle changed = deviating(vehicle_, deviation);
  Scene scene{.vehicle = changed,
              .sharing = LoadSharing(changed),
              .axes = PatchAxes(ground->mean, gravity_mps2_),
              .hollow_1pm = ground->mean.curvature_1pm,
              .models = {}};
  for (std::size_t i = 0; i < changed.wheels.size(); ++i) {
    const double steer = input.steer_rad.at(i) + deviation.steering_offset_rad.at(i);
    scene.wheels.at(i) = {.cos_steer = std::cos(steer), .sin_steer = std::sin(steer)};
    scene.rim_mps.at(i) =
        input.rim_rad_s.at(i) * vehicle_.wheel.radius_m * (1 + deviation.radius_share);
  }
  WindowPrediction prediction{
      .pitch_rad = std::atan(ground->mean.slope_forward) + deviation.mounting_pitch_rad,
      .roll_rad = std::atan(ground->mean.slope_left / std::hypot(1, ground->mean.slope_forward)) +
                  deviation.mounting_roll_rad};
  for (const auto& [soils, share] : ground->soils) {
    scene.models.clear();
    for (std::size_t i = 0; i < changed.wheels.size(); ++i) {
      const auto soil = static_cast<std::size_t>(soils.at(i));
      scene.models.emplace_back(WheelModelSpec{.wheel = vehicle_.wheel,
                                               .soil = deviating(map_.soils()[soil].soil,
                                                                 numbers_at(deviation, soil, zone)),
                                               .gravity_mps2 = gravity_mps2_},
                                WheelAccuracy::kFast);
    }
    const auto v = balanced(scene, input, deviation.tow_drag_n);
    if (!v) return {};
    const Sums sums = sums_at(scene, motion_of(*v), reaction_at(scene, input, *v));
    if (!sums.carried) return {};
    // Told at the point that is taken to be below the centre of gravity.
    const double vx = (*v)[0] + (*v)[2] * deviation.cg_left_m;
    const double vy = (*v)[1] - (*v)[2] * deviation.cg_forward_m;
    const PatchAxes& axes = scene.axes;
    const double forward = axes.forward_per_vx * vx + axes.forward_per_vy * vy;
    const double left = axes.left_per_vy * vy;
    prediction.forward_mps += share * (forward - deviation.mounting_yaw_rad * -left);
    prediction.left_mps += share * (left - deviation.mounting_yaw_rad * forward);
    prediction.yaw_rate_rad_s += share * axes.yaw_per_turn * (*v)[2];
    for (std::size_t i = 0; i < vehicle_.wheels.size(); ++i) {
      prediction.torque_nm.at(i) += share * (sums.torque_nm.at(i) + deviation.wheel_drag_nm.at(i)) *
                                    (1 + deviation.motor_share.at(i));
    }
  }
  return prediction;
}

}  // namespace regoplan
