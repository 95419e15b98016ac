#include "drive_diagnosis/window_prediction.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "maps/ground_finder.h"
#include "terramech/wheel_loads.h"

namespace regoplan {
namespace {

/// A vehicle in a window, with its deviation worked in.
struct Scene {
  Vehicle vehicle;
  LoadSharing sharing;
  GroundPatch patch;
  PatchAxes axes;
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

std::optional<Scene> scene_of(const TerrainMap& map, const Vehicle& vehicle, double gravity_mps2,
                              const WindowInput& input, const VehicleDeviation& deviation) {
  const GroundPatch patch =
      GroundFinder(map, vehicle)
          .at(input.x_m - deviation.map_east_m, input.y_m - deviation.map_north_m, input.yaw_rad);
  if (!patch.known) return {};
  const Vehicle changed = deviating(vehicle, deviation);
  Scene scene{.vehicle = changed,
              .sharing = LoadSharing(changed),
              .patch = patch,
              .axes = PatchAxes(patch, gravity_mps2),
              .models = {}};
  for (std::size_t i = 0; i < vehicle.wheels.size(); ++i) {
    const MapSoil& soil = map.soils()[static_cast<std::size_t>(patch.soil.at(i))];
    scene.models.emplace_back(WheelModelSpec{.wheel = vehicle.wheel,
                                             .soil = weaker(soil.soil, deviation.weaker_soil),
                                             .gravity_mps2 = gravity_mps2},
                              WheelAccuracy::kFast);
    const double steer = input.steer_rad.at(i) + deviation.steering_offset_rad.at(i);
    scene.wheels.at(i) = {.cos_steer = std::cos(steer), .sin_steer = std::sin(steer)};
    scene.rim_mps.at(i) =
        input.rim_rad_s.at(i) * vehicle.wheel.radius_m * (1 + deviation.radius_share);
  }
  return scene;
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

/// What is left over of forces and moment at a motion, in units of the weight.
Vector imbalance(const Scene& scene, const WindowInput& input, double tow_drag_n,
                 const BodyMotion& motion, const GroundReaction& reaction) {
  const double m = scene.vehicle.mass_kg;
  const BodyForce force = sums_at(scene, motion, reaction).force;
  const double forward = force.forward_n + m * scene.axes.gravity_forward_mps2 - tow_drag_n -
                         m * (input.acceleration_mps2 - motion.vy_mps * motion.yaw_rate_rad_s);
  const double left =
      force.left_n + m * scene.axes.gravity_left_mps2 - m * motion.vx_mps * motion.yaw_rate_rad_s;
  const double weight_n = m * scene.axes.gravity_normal_mps2;
  return Vector{forward, left, force.yaw_nm} / weight_n;
}

BodyMotion motion_of_vector(const Vector& v) {
  return {.vx_mps = v[0], .vy_mps = v[1], .yaw_rate_rad_s = v[2]};
}

}  // namespace

Soil weaker(const UncertainSoil& soil, double deviations) {
  Soil result = soil.mean;
  for (double Soil::*member :
       {&Soil::cohesion_pa, &Soil::friction_angle_rad, &Soil::kc, &Soil::kphi}) {
    const double mean = soil.mean.*member, std = soil.standard_deviation.*member;
    const double share = mean != 0 && std > 0 ? std / std::abs(mean) : 0.1;
    result.*member = mean * std::exp(-share * deviations);
  }
  return result;
}

WindowModel::WindowModel(const TerrainMap& map, const Vehicle& vehicle, double gravity_mps2)
    : map_(map), vehicle_(vehicle), gravity_mps2_(gravity_mps2) {}

std::optional<WindowPrediction> WindowModel::predict(const WindowInput& input,
                                                     const VehicleDeviation& deviation) const {
  const std::optional<Scene> scene = scene_of(map_, vehicle_, gravity_mps2_, input, deviation);
  if (!scene) return {};
  const double m = scene->vehicle.mass_kg;
  Vector v{input.speed_mps, 0, input.yaw_rate_rad_s};
  const auto reaction_at = [&](const Vector& at) {
    return GroundReaction{
        .normal_n = m * scene->axes.gravity_normal_mps2,
        .forward_n = m * (input.acceleration_mps2 - scene->axes.gravity_forward_mps2),
        .left_n = m * (at[0] * at[2] - scene->axes.gravity_left_mps2)};
  };
  constexpr int kSteps = 25;
  bool settled = false;
  for (int step = 0; step < kSteps && !settled; ++step) {
    const GroundReaction reaction = reaction_at(v);
    const Vector here =
        imbalance(*scene, input, deviation.tow_drag_n, motion_of_vector(v), reaction);
    Eigen::Matrix3d slopes;
    const double h = 1e-5 * std::max(std::abs(v[0]), 0.05);
    for (int k = 0; k < 3; ++k) {
      Vector moved = v;
      moved[k] += h;
      slopes.col(k) = (imbalance(*scene, input, deviation.tow_drag_n, motion_of_vector(moved),
                                 reaction_at(moved)) -
                       here) /
                      h;
    }
    Vector change = -slopes.fullPivLu().solve(here);
    const double reach = 0.2 * std::max(std::abs(v[0]), 0.05);
    const double largest = change.cwiseAbs().maxCoeff();
    if (!std::isfinite(largest)) return {};
    if (largest > reach) change *= reach / largest;
    v += change;
    constexpr double kClose = 1e-7;
    settled = largest < kClose;
  }
  if (!settled) return {};
  const Sums sums = sums_at(*scene, motion_of_vector(v), reaction_at(v));
  if (!sums.carried) return {};
  const PatchAxes& axes = scene->axes;
  WindowPrediction prediction{
      .forward_mps = axes.forward_per_vx * v[0] + axes.forward_per_vy * v[1],
      .left_mps = axes.left_per_vy * v[1],
      .yaw_rate_rad_s = axes.yaw_per_turn * v[2]};
  for (std::size_t i = 0; i < vehicle_.wheels.size(); ++i) {
    prediction.torque_nm.at(i) =
        (sums.torque_nm.at(i) + deviation.wheel_drag_nm.at(i)) * (1 + deviation.motor_share);
  }
  return prediction;
}

}  // namespace regoplan
