#include "drive_diagnosis/comparison/window_prediction.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "terramech/vehicle/steered_wheel.h"
#include "terramech/vehicle/wheel_loads.h"
#include "terramech/wheel/wheel_model.h"

namespace regoplan {
namespace {

using Soils = std::array<std::int16_t, kMaxWheels>;

/// A vehicle at a place, with its deviation worked in.
struct Scene {
  const Vehicle& vehicle;
  const LoadSharing& sharing;
  const WindowInput::Place& input;
  const BodyMotion* before = nullptr;       ///< at the place before; null at the first
  const BodyMotion* long_before = nullptr;  ///< before that; null at the first two
  double step_s = 0;                        ///< from place to place
  double slow_mps = 0;      ///< steps of the search for a motion are no shorter at less speed
  double tow_drag_n = 0;    ///< along the vehicle, against its way
  double pull_by_load = 0;  ///< see VehicleDeviation
  PatchAxes axes;
  double hollow_1pm = 0;
  std::array<const WheelModel*, kMaxWheels> models{};
  std::array<SteeredWheel, kMaxWheels> wheels{};
  std::array<double, kMaxWheels> rim_mps{};
};

Vehicle deviating(Vehicle vehicle, const VehicleDeviation& deviation) {
  vehicle.mass_kg *= 1 + deviation.payload_share;
  return with_centre_moved(std::move(vehicle), deviation.cg_forward_m, deviation.cg_left_m,
                           deviation.cg_up_m);
}

Soils soils_under(const TerrainMap& map, const Vehicle& vehicle, const WindowPart& place,
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

/// The ground below a place, shifted as the map is said to lie off.
GroundPatch ground_of(const GroundFinder& finder, const TerrainMap& map, const Vehicle& vehicle,
                      WindowPart place, const VehicleDeviation& deviation) {
  place.x_m -= deviation.map_east_m;
  place.y_m -= deviation.map_north_m;
  place.yaw_rad -= deviation.mounting_yaw_rad;
  GroundPatch patch = finder.at(place.x_m, place.y_m, place.yaw_rad);
  for (double* of : {&patch.slope_forward, &patch.slope_left, &patch.curvature_1pm}) {
    *of *= 1 + deviation.map_height_share;
  }
  const bool borders_lie_off = deviation.soil_east_m != 0 || deviation.soil_north_m != 0;
  if (patch.known && borders_lie_off) {
    place.x_m -= deviation.soil_east_m;
    place.y_m -= deviation.soil_north_m;
    patch.soil = soils_under(map, vehicle, place, patch.soil);
  }
  return patch;
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
  std::array<double, kMaxWheels> uneven_load_n{};  ///< see WindowMotions
  bool carried = true;
};

Sums sums_at(const Scene& scene, const BodyMotion& motion, const GroundReaction& reaction) {
  Sums sums;
  const double mean_load_n = reaction.normal_n / static_cast<double>(scene.vehicle.wheels.size());
  for (std::size_t i = 0; i < scene.vehicle.wheels.size(); ++i) {
    const double load_n = scene.sharing.load_n(i, reaction);
    if (!(load_n > 0)) {
      sums.carried = false;
      continue;
    }
    const WheelMount& mount = scene.vehicle.wheels[i];
    WheelForces forces = scene.models.at(i)->forces(
        load_n, wheel_motion(mount, scene.wheels.at(i), motion, scene.rim_mps.at(i)));
    sums.uneven_load_n.at(i) = load_n * (load_n / mean_load_n - 1);
    forces.fx_n += scene.pull_by_load * sums.uneven_load_n.at(i);
    if (!has_forces(forces.status)) sums.carried = false;
    sums.force.add(mount, scene.wheels.at(i), forces);
    sums.torque_nm.at(i) = forces.torque_nm;
  }
  return sums;
}

/// As slow as wheels go that are compared.
constexpr double kSlow_mps = kMoving_mps / 2;

using Vector = Eigen::Vector3d;

BodyMotion motion_of(const Vector& v) {
  return {.vx_mps = v[0], .vy_mps = v[1], .yaw_rate_rad_s = v[2]};
}

Vector vector_of(const BodyMotion& motion) {
  return {motion.vx_mps, motion.vy_mps, motion.yaw_rate_rad_s};
}

/// Rates of change of the velocities along and across, and of the yaw rate.
Vector accelerations_at(const Scene& scene, const Vector& v) {
  const WindowInput::Place& input = scene.input;
  const Vector more{input.more_mps2, 0, input.more_rps2};
  if (!scene.before) {
    return more + Vector{input.acceleration_mps2, 0, input.yaw_acceleration_rps2};
  }
  const Vector before = vector_of(*scene.before);
  if (!scene.long_before) return more + (v - before) / scene.step_s;
  return more + (1.5 * v - 2 * before + 0.5 * vector_of(*scene.long_before)) / scene.step_s;
}

GroundReaction reaction_at(const Scene& scene, const Vector& v) {
  const double m = scene.vehicle.mass_kg;
  const Vector rate = accelerations_at(scene, v);
  return {.normal_n = m * (scene.axes.gravity_normal_mps2 + v[0] * v[0] * scene.hollow_1pm),
          .forward_n = m * (rate[0] - v[1] * v[2] - scene.axes.gravity_forward_mps2),
          .left_n = m * (rate[1] + v[0] * v[2] - scene.axes.gravity_left_mps2)};
}

/// What is left over of forces and moment at a motion, in units of the weight.
struct Imbalance {
  Vector left_over;
  Sums sums;
};

Imbalance imbalance(const Scene& scene, const Vector& v) {
  const GroundReaction needed = reaction_at(scene, v);
  const Sums sums = sums_at(scene, motion_of(v), needed);
  const BodyForce& force = sums.force;
  const double weight_n = scene.vehicle.mass_kg * scene.axes.gravity_normal_mps2;
  const double turning = scene.vehicle.yaw_inertia_kgm2 * accelerations_at(scene, v)[2];
  const Vector left_over{force.forward_n - scene.tow_drag_n - needed.forward_n,
                         force.left_n - needed.left_n, force.yaw_nm - turning};
  return {left_over / weight_n, sums};
}

Eigen::Matrix3d response_at(const Scene& scene, const Vector& v, const Vector& here) {
  Eigen::Matrix3d slopes;
  const double h = 1e-5 * std::max(std::abs(v[0]), scene.slow_mps);
  for (int k = 0; k < 3; ++k) {
    Vector moved = v;
    moved[k] += h;
    slopes.col(k) = (imbalance(scene, moved).left_over - here) / h;
  }
  return slopes.fullPivLu().inverse();
}

/// A motion at which nothing is left over, and what the wheels do at it.
struct Balance {
  MotionStart found;
  Sums sums;
};

/// Newton's method with slopes by differences, taken anew where the last ones serve badly; its
/// steps are kept short. The last step is so short that forces are those before it.
std::optional<Balance> balanced(const Scene& scene, const MotionStart& start) {
  const auto& [motion, known] = start;
  Vector v = vector_of(motion);
  Eigen::Matrix3d response = known;
  bool is_slow = known.isZero();
  double last = std::numeric_limits<double>::infinity();
  constexpr int kSteps = 25;
  for (int step = 0; step < kSteps; ++step) {
    const Imbalance here = imbalance(scene, v);
    if (is_slow) response = response_at(scene, v, here.left_over);
    Vector change = -response * here.left_over;
    const double reach = 0.2 * std::max(std::abs(v[0]), scene.slow_mps);
    const double largest = change.cwiseAbs().maxCoeff();
    if (!std::isfinite(largest)) return {};
    if (largest > reach) change *= reach / largest;
    v += change;
    constexpr double kClose = 2e-5, kSlow = 0.2;
    if (largest < kClose * scene.slow_mps) return Balance{{motion_of(v), response}, here.sums};
    is_slow = largest > kSlow * last;
    last = largest;
  }
  return {};
}

/// A motion, moved by as much as the search for another one moved it.
BodyMotion moved_as(const BodyMotion& motion, const MotionStart& taken, const MotionStart& found) {
  return motion_of(vector_of(motion) + vector_of(found.motion) - vector_of(taken.motion));
}

double sign_of(double way) {
  return way == 0 ? 0 : std::copysign(1, way);
}

/// Adds a place to what is said of its window, by its shares.
void add_place(const WindowInput::Place& place, const WindowMotions::Place& found,
               double window_yaw_rad, const VehicleDeviation& deviation, const Vehicle& vehicle,
               WindowPrediction& prediction) {
  const WindowPart& part = place.part;
  const BodyMotion& motion = found.found.motion;
  // Told at the point that is taken to be below the centre of gravity.
  const double vx = motion.vx_mps + motion.yaw_rate_rad_s * deviation.cg_left_m;
  const double vy = motion.vy_mps - motion.yaw_rate_rad_s * deviation.cg_forward_m;
  const PatchAxes& axes = found.axes;
  const double forward = axes.forward_per_vx * vx + axes.forward_per_vy * vy;
  const double left = axes.left_per_vy * vy;
  const double turned = part.yaw_rad - window_yaw_rad;
  const double c = std::cos(turned), s = std::sin(turned);
  prediction.forward_mps += part.track_share * (c * forward - s * left);
  prediction.left_mps += part.track_share * (s * forward + c * left);
  prediction.yaw_rate_rad_s += part.turn_share * axes.yaw_per_turn * motion.yaw_rate_rad_s;
  for (std::size_t i = 0; i < vehicle.wheels.size(); ++i) {
    const double drag_nm = sign_of(place.rim_rad_s.at(i)) * deviation.wheel_drag_nm.at(i);
    const double by_load_nm =
        deviation.torque_by_load * vehicle.wheel.radius_m * found.uneven_load_n.at(i);
    prediction.torque_nm.at(i) += part.mean_share * (found.torque_nm.at(i) + by_load_nm + drag_nm) *
                                  (1 + deviation.motor_share.at(i));
  }
}

/// What the attitude sensor says at a place whose ground it lies on.
struct Attitude {
  double pitch_rad = 0, roll_rad = 0;
};

Attitude attitude_on(const WindowMotions::Place& ground) {
  return {.pitch_rad = std::atan(ground.slope_forward),
          .roll_rad = std::atan(ground.slope_left / std::hypot(1, ground.slope_forward))};
}

/// The attitude that is told at a place: that of an earlier time where it is told late.
Attitude attitude_told(const std::vector<WindowMotions::Place>& places, std::size_t j,
                       double step_s, double late_s) {
  const Attitude here = attitude_on(places[j]);
  const std::size_t from = j == 0 ? 0 : j - 1, to = std::min(j + 1, places.size() - 1);
  if (late_s == 0 || from == to) return here;
  const Attitude before = attitude_on(places[from]), after = attitude_on(places[to]);
  const double share = late_s / (step_s * static_cast<double>(to - from));
  return {.pitch_rad = here.pitch_rad - share * (after.pitch_rad - before.pitch_rad),
          .roll_rad = here.roll_rad - share * (after.roll_rad - before.roll_rad)};
}

WheelTime wheel_time(const WindowInput& input, const WindowInput::Place& place,
                     const WheelMount& wheel) {
  const double by_m_s = input.forward_mps == 0 ? 0 : 1 / input.forward_mps;
  return {.at_s = (place.part.start_s + place.part.end_s) / 2 + by_m_s * wheel.x_m,
          .left_s = by_m_s * wheel.y_m};
}

/// Whether two deviations move the vehicle alike: what they differ in is told by sensors alone, or
/// is of soils that no wheel is on.
bool move_alike(const VehicleDeviation& a, VehicleDeviation b, const std::vector<bool>& on_soil) {
  b.wheel_drag_nm = a.wheel_drag_nm;
  b.motor_share = a.motor_share;
  b.torque_by_load = a.torque_by_load;
  b.mounting_pitch_rad = a.mounting_pitch_rad;
  b.mounting_roll_rad = a.mounting_roll_rad;
  b.attitude_late_s = a.attitude_late_s;
  b.tilt_share = a.tilt_share;
  std::vector<SoilNumbers> soils = a.soils;
  soils.resize(on_soil.size());
  b.soils.resize(on_soil.size());
  for (std::size_t i = 0; i < on_soil.size(); ++i) {
    if (!on_soil[i]) b.soils[i] = soils[i];
  }
  VehicleDeviation same = a;
  same.soils = std::move(soils);
  return same == b;
}

/// The same by a sensor of heading that does not look along the vehicle.
WindowPrediction told_by_sensors(WindowPrediction prediction, const VehicleDeviation& deviation) {
  const double forward = prediction.forward_mps, left = prediction.left_mps;
  prediction.forward_mps += deviation.mounting_yaw_rad * left;
  prediction.left_mps -= deviation.mounting_yaw_rad * forward;
  return prediction;
}

}  // namespace

WindowModel::WindowModel(const TerrainMap& map, const Vehicle& vehicle, double gravity_mps2)
    : map_(map),
      vehicle_(vehicle),
      ground_(map, vehicle),
      gravity_mps2_(gravity_mps2),
      wheels_(map.soils(), vehicle.wheel, gravity_mps2) {}

bool WindowModel::knows_ground(const WindowInput& input) const {
  return std::ranges::all_of(input.places, [this](const WindowInput::Place& place) {
    return ground_.at(place.part.x_m, place.part.y_m, place.part.yaw_rad).known;
  });
}

BodyMotion rolling_motion(const Vehicle& vehicle, const std::array<double, kMaxWheels>& rim_rad_s,
                          const std::array<double, kMaxWheels>& steer_rad) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Vector sum = Vector::Zero();
  for (std::size_t i = 0; i < vehicle.wheels.size(); ++i) {
    const WheelMount& mount = vehicle.wheels[i];
    const double rim_mps = rim_rad_s.at(i) * vehicle.wheel.radius_m;
    const Vector forward{1, 0, -mount.y_m}, left{0, 1, mount.x_m};
    normal += forward * forward.transpose() + left * left.transpose();
    sum += rim_mps * (std::cos(steer_rad.at(i)) * forward + std::sin(steer_rad.at(i)) * left);
  }
  return motion_of(normal.ldlt().solve(sum));
}

std::vector<WheelTime> WindowModel::wheel_times(const WindowInput& input,
                                                const WindowInput::Place& place,
                                                const VehicleDeviation& deviation) const {
  std::vector<WheelTime> times;
  for (const WheelMount& wheel : deviating(vehicle_, deviation).wheels) {
    times.push_back(wheel_time(input, place, wheel));
  }
  return times;
}

WindowMotions WindowModel::motions(const WindowInput& input, const VehicleDeviation& deviation,
                                   const std::vector<SoilStretch>& stretches) const {
  const Vehicle changed = deviating(vehicle_, deviation);
  const LoadSharing sharing(changed);
  // On the map's soils, then in each of the stretches.
  const std::size_t soils = map_.soils().size();
  WindowMotions motions{.deviation = deviation,
                        .stretches = stretches,
                        .places = {},
                        .on_soil = std::vector<bool>(soils, false)};
  std::vector<std::shared_ptr<const WheelModel>> models(soils * (1 + stretches.size()));
  const auto model_of = [&](std::size_t group, std::size_t soil, const SoilNumbers& numbers) {
    std::shared_ptr<const WheelModel>& model = models[group * soils + soil];
    if (!model) {
      motions.on_soil[soil] = true;
      model = wheels_.on(soil, numbers_at(deviation, soil, numbers));
    }
    return model.get();
  };
  const auto model_at = [&](const WheelTime& time, std::size_t soil) {
    const auto on = std::ranges::find_if(
        stretches, [&time](const SoilStretch& stretch) { return stretch.holds(time); });
    if (on == stretches.end()) return model_of(0, soil, {});
    return model_of(1 + static_cast<std::size_t>(on - stretches.begin()),
                    on->soil == kAsMapped ? soil : static_cast<std::size_t>(on->soil), on->numbers);
  };
  std::vector<WindowMotions::Place> places;
  places.reserve(input.places.size());
  for (std::size_t j = 0; j < input.places.size(); ++j) {
    const WindowInput::Place& place = input.places[j];
    GroundPatch patch = ground_of(ground_, map_, vehicle_, place.part, deviation);
    if (!patch.known) return motions;
    patch.slope_forward += place.more_slope_forward;
    patch.slope_left += place.more_slope_left;
    Scene scene{.vehicle = changed,
                .sharing = sharing,
                .input = place,
                .before = j > 0 ? &places[j - 1].found.motion : nullptr,
                .long_before = j > 1 ? &places[j - 2].found.motion : nullptr,
                .step_s = place.part.end_s - place.part.start_s,
                .slow_mps = kSlow_mps * input.pace,
                .tow_drag_n = sign_of(input.forward_mps) * deviation.tow_drag_n,
                .pull_by_load = deviation.pull_by_load,
                .axes = PatchAxes(patch, gravity_mps2_),
                .hollow_1pm = patch.curvature_1pm};
    for (std::size_t i = 0; i < changed.wheels.size(); ++i) {
      const double steer = place.steer_rad.at(i) + deviation.steering_offset_rad.at(i);
      scene.wheels.at(i) = {.cos_steer = std::cos(steer), .sin_steer = std::sin(steer)};
      const double rim_rad_s =
          place.rim_rad_s.at(i) + deviation.wheel_speed_late_s.at(i) * place.rim_rad_s2.at(i);
      scene.rim_mps.at(i) = rim_rad_s * vehicle_.wheel.radius_m *
                            (1 + deviation.radius_share + deviation.wheel_radius_share.at(i));
      scene.models.at(i) = model_at(wheel_time(input, place, changed.wheels[i]),
                                    static_cast<std::size_t>(patch.soil.at(i)));
    }
    // What changes the motion at one place changes it much alike at the next.
    MotionStart near = place.near;
    if (j > 0) near.motion = moved_as(near.motion, input.places[j - 1].near, places[j - 1].found);
    auto balance = balanced(scene, near);
    if (!balance) balance = balanced(scene, place.start);
    if (!balance || !balance->sums.carried) return motions;
    places.push_back({.found = balance->found,
                      .axes = scene.axes,
                      .slope_forward = patch.slope_forward,
                      .slope_left = patch.slope_left,
                      .torque_nm = balance->sums.torque_nm,
                      .uneven_load_n = balance->sums.uneven_load_n});
  }
  motions.places = std::move(places);
  return motions;
}

std::optional<WindowPrediction> WindowModel::predict(const WindowInput& input,
                                                     const VehicleDeviation& deviation,
                                                     const std::vector<SoilStretch>& stretches,
                                                     const WindowMotions* known) const {
  const bool is_known = known != nullptr && known->stretches == stretches &&
                        move_alike(known->deviation, deviation, known->on_soil);
  std::optional<WindowMotions> anew;
  if (!is_known) known = &anew.emplace(motions(input, deviation, stretches));
  if (!known->places) return {};
  WindowPrediction prediction{.pitch_rad = deviation.mounting_pitch_rad,
                              .roll_rad = deviation.mounting_roll_rad};
  for (std::size_t j = 0; j < input.places.size(); ++j) {
    const WindowMotions::Place& place = (*known->places)[j];
    const WindowPart& part = input.places[j].part;
    add_place(input.places[j], place, input.yaw_rad, deviation, vehicle_, prediction);
    const Attitude told =
        attitude_told(*known->places, j, part.end_s - part.start_s, deviation.attitude_late_s);
    const double share = part.mean_share * (1 + deviation.tilt_share);
    prediction.pitch_rad += share * told.pitch_rad;
    prediction.roll_rad += share * told.roll_rad;
    prediction.found.push_back(place.found);
  }
  return told_by_sensors(prediction, deviation);
}

}  // namespace regoplan
