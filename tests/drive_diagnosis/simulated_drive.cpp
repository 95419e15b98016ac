#include "tests/drive_diagnosis/simulated_drive.h"

#include <cmath>
#include <limits>
#include <random>

#include "maps/ground_finder.h"
#include "terramech/basics/angles.h"
#include "terramech/force_table/force_table.h"
#include "terramech/vehicle/vehicle_dynamics.h"
#include "tests/terramech/named_soils.h"

namespace regoplan {
namespace {

constexpr double kGravity_mps2 = 1.62;

constexpr int kWeaknesses = 10;  ///< soils in steps of one standard deviation

UncertainSoil tested_soil() {
  UncertainSoil soil{.mean = named_soils::firm_regolith()};
  soil.standard_deviation.cohesion_pa = 0.2 * soil.mean.cohesion_pa;
  soil.standard_deviation.friction_angle_rad = 2 * kDegree;
  soil.standard_deviation.kc = 0.2 * soil.mean.kc;
  soil.standard_deviation.kphi = 0.2 * soil.mean.kphi;
  return soil;
}

void add(DriveRecording& recording, const std::string& name, double value) {
  DriveChannel* channel = recording.channel(name);
  if (!channel) {
    recording.channels.push_back({name, {}});
    channel = &recording.channels.back();
  }
  channel->values.push_back(static_cast<float>(value));
}

}  // namespace

TerrainMap map_of_heights(const std::function<double(int column, int row)>& height_m) {
  ElevationRaster elevation{.frame = {.columns = 320,
                                      .rows = 60,
                                      .west_m = 0,
                                      .north_m = 60,
                                      .cell_width_m = 1,
                                      .cell_height_m = 1},
                            .height_m = {}};
  for (int row = 0; row < 60; ++row) {
    for (int column = 0; column < 320; ++column) {
      elevation.height_m.push_back(static_cast<float>(height_m(column, row)));
    }
  }
  return TerrainMap(
      std::move(elevation), {},
      SoilCatalogue{.soils = {{"mare", "assumed", tested_soil()}}, .classes = {}, .unmapped = 0},
      {});
}

TerrainMap rolling_map() {
  return map_of_heights([](int column, int row) {
    return 1.2 * std::sin(column / 18.0) + 0.5 * std::sin(row / 9.0 + column / 31.0);
  });
}

DriveRecording record(const SimulatedDrive& drive, const TerrainMap& map) {
  const Vehicle vehicle = preset_vehicle("lrv");
  std::vector<WheelModel> models;
  for (int i = 0; i < kWeaknesses; ++i) {
    models.emplace_back(WheelModelSpec{.wheel = vehicle.wheel,
                                       .soil = weaker(tested_soil(), i),
                                       .gravity_mps2 = kGravity_mps2},
                        WheelAccuracy::kFast);
  }
  const std::vector<WheelLaw> laws(models.begin(), models.end());
  const GroundFinder finder(map, vehicle);
  const VehicleDynamics dynamics(
      vehicle, laws,
      [&](double x_m, double y_m, double yaw_rad) {
        GroundPatch patch = finder.at(x_m, y_m, yaw_rad);
        for (std::size_t i = 0; i < vehicle.wheels.size(); ++i) {
          const WheelMount& wheel = vehicle.wheels[i];
          const double there_m =
              x_m + std::cos(yaw_rad) * wheel.x_m - std::sin(yaw_rad) * wheel.y_m;
          patch.soil.at(i) = static_cast<std::int16_t>(std::lround(drive.weakness(there_m)));
        }
        return patch;
      },
      kGravity_mps2);
  std::mt19937_64 random(drive.seed);
  std::normal_distribution<double> normal;
  std::mt19937_64 random_of_attitude(drive.seed + 1);
  const auto attitude_noise = [&] { return 0.3 * kDegree * normal(random_of_attitude); };
  DriveRecording recording{.drive_id = "simulated", .file = "simulated.csv"};
  VehicleState state = dynamics.rolling_state(6, 30, 0, 1.2);
  std::array<double, kMaxWheels> ground{};
  const double noise = drive.sensor_noise;
  constexpr double kStep_s = 0.1, kEnd_m = 308;
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  for (int step = 0; step < 5000 && state.x_m < kEnd_m; ++step) {
    const double back = -0.01 * (state.y_m - 30) - 0.2 * state.yaw_rad;
    const double time_s = step * kStep_s;
    state = dynamics
                .step(state,
                      {.speed_target_mps = drive.speed_mps(time_s, state.x_m),
                       .curvature_target_1pm =
                           std::clamp(back + drive.weave_1pm(time_s, state.x_m), -0.15, 0.15)},
                      kStep_s)
                .state;
    const bool fix = step % std::lround(drive.fixes_s / kStep_s) == 0;
    recording.time_s.push_back(time_s);
    recording.x_m.push_back(fix ? state.x_m + noise * 0.02 * normal(random) : kNaN);
    recording.y_m.push_back(fix ? state.y_m + noise * 0.02 * normal(random) : kNaN);
    add(recording, "yaw_rad", fix ? state.yaw_rad + noise * kDegree * normal(random) : kNaN);
    const GroundPatch patch = dynamics.ground(state.x_m, state.y_m, state.yaw_rad);
    if (drive.attitude) {
      const double slope = patch.slope_forward;
      const double tilt = 1 + drive.deviation.tilt_share;
      add(recording, "pitch_rad", tilt * std::atan(slope) + attitude_noise());
      add(recording, "roll_rad",
          tilt * std::atan(patch.slope_left / std::hypot(1, slope)) + attitude_noise());
    }
    const PatchAxes axes(patch, kGravity_mps2);
    const GroundReaction reaction{vehicle.mass_kg * axes.gravity_normal_mps2,
                                  state.transfer_forward_n, state.transfer_left_n};
    const auto set = steered_wheels(vehicle, {state.curvature_1pm, 0});
    for (std::size_t i = 0; i < vehicle.wheels.size(); ++i) {
      const WheelMount& mount = vehicle.wheels[i];
      const double rim_mps = state.rim_speed_mps * set.at(i).rim_speed_per_speed;
      const double load_n = dynamics.sharing().load_n(i, reaction);
      const double mean_load_n = reaction.normal_n / static_cast<double>(vehicle.wheels.size());
      const double torque_nm =
          laws[static_cast<std::size_t>(patch.soil.at(i))]
              .forces(load_n, wheel_motion(mount, set.at(i), state.motion, rim_mps))
              .torque_nm +
          drive.deviation.torque_by_load * vehicle.wheel.radius_m * load_n *
              (load_n / mean_load_n - 1);
      constexpr double kHold = 0.9;  // the ground changes over about a metre
      ground.at(i) = kHold * ground.at(i) +
                     std::sqrt(1 - kHold * kHold) * drive.torque_scatter * normal(random);
      add(recording, "wheel_speed_" + mount.name + "_rad_s",
          rim_mps / vehicle.wheel.radius_m * (1 + noise * 0.01 * normal(random)));
      if (mount.steered) {
        add(recording, "steer_" + mount.name + "_rad",
            set.at(i).steer_rad() - drive.deviation.steering_offset_rad.at(i));
      }
      add(recording, "torque_" + mount.name + "_nm",
          (torque_nm * (1 + ground.at(i)) + drive.deviation.wheel_drag_nm.at(i)) *
              (1 + drive.deviation.motor_share.at(i)));
    }
  }
  return recording;
}

}  // namespace regoplan
