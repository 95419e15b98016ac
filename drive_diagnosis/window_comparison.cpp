#include "drive_diagnosis/window_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "drive_diagnosis/robust_statistics.h"
#include "terramech/basics/angles.h"
#include "terramech/basics/interruption.h"

namespace regoplan {
namespace {

/// The rim speed of a wheel, its own or its side's.
double rim_rad_s(const DriveRecording& drive, const DriveWindow& window, const WheelMount& mount) {
  const double own = channel_mean(drive, window, fmt::format("wheel_speed_{}_rad_s", mount.name));
  if (!std::isnan(own)) return own;
  return channel_mean(drive, window,
                      mount.y_m > 0 ? "wheel_speed_left_rad_s" : "wheel_speed_right_rad_s");
}

double steer_of(const DriveRecording& drive, const DriveWindow& window, const Vehicle& vehicle,
                const WheelMount& mount) {
  if (!mount.steered) return 0;
  const double own = channel_mean(drive, window, fmt::format("steer_{}_rad", mount.name));
  if (!std::isnan(own)) return own;
  return steer_angle_rad(vehicle, mount, channel_mean(drive, window, "curvature_1pm"));
}

std::optional<WindowInput> input_of(const DriveRecording& drive, const DriveWindow& window,
                                    const Vehicle& vehicle) {
  if (!(std::abs(window.forward_mps) > kMoving_mps / 2)) return {};
  WindowInput input{.acceleration_mps2 = window.acceleration_mps2,
                    .speed_mps = window.forward_mps,
                    .yaw_rate_rad_s = window.yaw_rate_rad_s};
  if (!std::isnan(window.wheel_acceleration_rad_s2)) {
    input.acceleration_mps2 = window.wheel_acceleration_rad_s2 * vehicle.wheel.radius_m;
  }
  const double c = std::cos(window.course_rad), s = std::sin(window.course_rad);
  const double along =
      std::copysign(input.acceleration_mps2, input.acceleration_mps2 * window.forward_mps);
  for (std::size_t j = 0; j < WindowInput::kPlaces; ++j) {
    const double t =
        window.duration_s() * ((static_cast<double>(j) + 0.5) / WindowInput::kPlaces - 0.5);
    const double way = window.speed_mps * t + along * t * t / 2;
    const double aside = window.speed_mps * window.yaw_rate_rad_s * t * t / 2;
    input.places.at(j) = {.x_m = window.x_m + c * way - s * aside,
                          .y_m = window.y_m + s * way + c * aside,
                          .yaw_rad = window.yaw_rad + window.yaw_rate_rad_s * t};
  }
  double all = window.x_m + window.y_m + window.yaw_rad + window.yaw_rate_rad_s;
  for (std::size_t i = 0; i < vehicle.wheels.size(); ++i) {
    input.rim_rad_s.at(i) = rim_rad_s(drive, window, vehicle.wheels[i]);
    input.steer_rad.at(i) = steer_of(drive, window, vehicle, vehicle.wheels[i]);
    all += input.rim_rad_s.at(i) + input.steer_rad.at(i);
  }
  if (!std::isfinite(all + input.acceleration_mps2)) return {};
  return input;
}

/// How far a window's mean of a channel scatters, from neighbouring samples of the whole drive.
double mean_std(const DriveRecording& drive, const DriveWindow& window, const std::string& name) {
  const DriveChannel* channel = drive.channel(name);
  if (!channel) return 0;
  double squares = 0, last = kNotSampled;
  int steps = 0, within = 0;
  for (std::size_t i = 0; i < drive.size(); ++i) {
    const auto value = static_cast<double>(channel->values[i]);
    if (std::isnan(value)) continue;
    if (drive.time_s[i] >= window.start_s && drive.time_s[i] <= window.end_s) ++within;
    constexpr double kTurns_rad_s = 1e-3;
    if (std::abs(value) > kTurns_rad_s && !std::isnan(last)) {
      squares += (value - last) * (value - last);
      ++steps;
    }
    last = value;
  }
  return steps == 0 || within == 0 ? 0 : std::sqrt(squares / (2.0 * steps * within));
}

/// How far the side force that the steering asks for varies in a window: standard deviation, as a
/// share of the weight.
double side_force_std(const DriveRecording& drive, const DriveWindow& window,
                      const Vehicle& vehicle, double gravity_mps2) {
  double middle_m = 0, spread_m2 = 0;
  for (const WheelMount& mount : vehicle.wheels) middle_m += mount.x_m;
  middle_m /= static_cast<double>(vehicle.wheels.size());
  std::vector<std::pair<const DriveChannel*, double>> levers;
  for (const WheelMount& mount : vehicle.wheels) {
    spread_m2 += (mount.x_m - middle_m) * (mount.x_m - middle_m);
    const DriveChannel* steer = drive.channel(fmt::format("steer_{}_rad", mount.name));
    if (mount.steered && steer) levers.emplace_back(steer, mount.x_m - middle_m);
  }
  const DriveChannel* told = drive.channel("curvature_1pm");
  double sum = 0, squares = 0;
  int samples = 0;
  for (std::size_t i = 0; i < drive.size(); ++i) {
    if (drive.time_s[i] < window.start_s || drive.time_s[i] > window.end_s) continue;
    double curvature_1pm = levers.empty() && told ? static_cast<double>(told->values[i]) : 0;
    for (const auto& [steer, lever_m] : levers) {
      curvature_1pm += lever_m * static_cast<double>(steer->values[i]) / spread_m2;
    }
    if (std::isnan(curvature_1pm)) continue;
    sum += curvature_1pm;
    squares += curvature_1pm * curvature_1pm;
    ++samples;
  }
  if (samples < 2) return 0;
  const double mean = sum / samples;
  return std::sqrt(std::max(0.0, squares / samples - mean * mean)) * window.speed_mps *
         window.speed_mps / gravity_mps2;
}

/// The model is one of steady driving: windows in which a vehicle starts, stops or changes its
/// acceleration, or the side force that it asks for, say nothing of the ground.
bool is_steady(const DriveRecording& drive, const DriveWindow& window, const Vehicle& vehicle,
               double gravity_mps2) {
  constexpr double kBendMost = 0.05, kRateLeast = 0.4, kSideForceMost = 0.04;
  return window.wheel_rate_bend <= kBendMost && window.wheel_rate_least >= kRateLeast &&
         side_force_std(drive, window, vehicle, gravity_mps2) <= kSideForceMost;
}

/// Collects trials; a trial's size is what a sound vehicle is off.
class Trials {
 public:
  template <class Set>
  void add(std::string id, std::string parameter, double unit, const Set& set) {
    VehicleTrial trial{std::move(id), std::move(parameter), unit, {}};
    set(trial.deviation, unit);
    trials.push_back(std::move(trial));
  }
  void add(std::string id, std::string parameter, double unit, double VehicleDeviation::*of) {
    add(std::move(id), std::move(parameter), unit,
        [of](VehicleDeviation& d, double size) { d.*of = size; });
  }
  std::vector<VehicleTrial> trials;
};

constexpr double kSoundDrag_nm = 0.2, kSoundSteer_deg = 0.1, kSoundMotor = 0.01;

void add_wheels(const Vehicle& vehicle, Trials& trials) {
  for (std::size_t i = 0; i < vehicle.wheels.size(); ++i) {
    const WheelMount& mount = vehicle.wheels[i];
    trials.add("wheel_drag", "drag_" + mount.name + "_nm", kSoundDrag_nm,
               [i](VehicleDeviation& d, double size) { d.wheel_drag_nm.at(i) = size; });
    trials.add("motor_constant", "torque_" + mount.name + "_share", kSoundMotor,
               [i](VehicleDeviation& d, double size) { d.motor_share.at(i) = size; });
    if (!mount.steered) continue;
    trials.add(
        "steering_offset", "steer_" + mount.name + "_deg", kSoundSteer_deg,
        [i](VehicleDeviation& d, double size) { d.steering_offset_rad.at(i) = size * kDegree; });
  }
}

void add_pairs(const Vehicle& vehicle, Trials& trials) {
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
    trials.add("side_drag", left ? "drag_left_nm" : "drag_right_nm", kSoundDrag_nm,
               [&](VehicleDeviation& d, double size) {
                 for (std::size_t i = 0; i < vehicle.wheels.size(); ++i) {
                   if ((vehicle.wheels[i].y_m > 0) == left) d.wheel_drag_nm.at(i) = size;
                 }
               });
  }
}

}  // namespace

std::vector<VehicleTrial> vehicle_trials(const Vehicle& vehicle, const TerrainMap& map,
                                         const std::vector<bool>& soils) {
  Trials trials;
  add_wheels(vehicle, trials);
  add_pairs(vehicle, trials);
  trials.add("motor_constant", "torque_share", kSoundMotor,
             [](VehicleDeviation& d, double size) { d.motor_share.fill(size); });
  trials.add("wheel_radius", "radius_share", 0.003, &VehicleDeviation::radius_share);
  trials.add("payload", "mass_share", 0.015, &VehicleDeviation::payload_share);
  trials.add("cg_offset", "forward_m", 0.015, &VehicleDeviation::cg_forward_m);
  trials.add("cg_offset", "left_m", 0.015, &VehicleDeviation::cg_left_m);
  trials.add("cg_offset", "up_m", 0.025, &VehicleDeviation::cg_up_m);
  trials.add("tow_drag", "drag_n", 3, &VehicleDeviation::tow_drag_n);
  trials.add("map_offset", "east_m", 0.3, &VehicleDeviation::map_east_m);
  trials.add("map_offset", "north_m", 0.3, &VehicleDeviation::map_north_m);
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
    const SoilNumbers spread = soil_spread(map.soils()[soil].soil);
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

WindowComparison::WindowComparison(const std::vector<DriveRecording>& drives,
                                   const std::vector<DriveWindow>& windows, const TerrainMap& map,
                                   const Vehicle& vehicle, double gravity_mps2)
    : drives_(drives),
      windows_(windows),
      map_(map),
      vehicle_(vehicle),
      model_(map, vehicle, gravity_mps2),
      soils_driven_(map.soils().size(), false) {
  choose_channels();
  constexpr std::size_t kWindowsMost = 150;  // the contest stays within seconds
  std::vector<Eigen::VectorXd> rows;
  for (std::size_t i = 0; i < windows_.size(); ++i) {
    const auto input = input_of(drives_[windows_[i].drive], windows_[i], vehicle_);
    if (!input || !model_.predict(*input, {})) continue;
    if (!is_steady(drives_[windows_[i].drive], windows_[i], vehicle_, gravity_mps2)) {
      ++unsteady_;
      continue;
    }
    auto measured = measured_in(i);
    if (!measured) continue;
    if (rows.size() == kWindowsMost) {
      ++left_out_;
      continue;
    }
    windows_of_.push_back(i);
    inputs_.push_back(*input);
    rim_std_rad_s_.emplace_back();
    for (std::size_t k = 0; k < vehicle_.wheels.size(); ++k) {
      rim_std_rad_s_.back().at(k) =
          mean_std(drives_[windows_[i].drive], windows_[i],
                   fmt::format("wheel_speed_{}_rad_s", vehicle_.wheels[k].name));
    }
    rows.push_back(std::move(*measured));
    for (const WindowInput::Place& place : input->places) {
      const auto soil = map_.soil_index(place.x_m, place.y_m);
      if (soil) soils_driven_[static_cast<std::size_t>(*soil)] = true;
    }
  }
  measured_.resize(static_cast<Eigen::Index>(rows.size()),
                   static_cast<Eigen::Index>(channels_.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    measured_.row(static_cast<Eigen::Index>(i)) = rows[i];
  }
  estimate_sampled_std();
}

void WindowComparison::estimate_sampled_std() {
  sampled_std_.assign(channels_.size(), 0);
  for (std::size_t k = 0; k < channels_.size(); ++k) {
    if (!scales(k)) continue;
    std::vector<double> of_windows;
    for (const std::size_t i : windows_of_) {
      of_windows.push_back(mean_std(drives_[windows_[i].drive], windows_[i], channels_[k]));
    }
    if (!of_windows.empty()) sampled_std_[k] = median_value(of_windows);
  }
}

void WindowComparison::choose_channels() {
  channels_ = {"speed_mps", "left_mps", "yaw_rate_rad_s"};
  const auto everywhere = [this](const std::string& name) {
    return std::ranges::all_of(
        drives_, [&](const DriveRecording& drive) { return drive.channel(name) != nullptr; });
  };
  has_attitude_ = everywhere("pitch_rad") && everywhere("roll_rad");
  if (has_attitude_) {
    channels_.emplace_back("pitch_rad");
    channels_.emplace_back("roll_rad");
  }
  for (std::size_t i = 0; i < vehicle_.wheels.size(); ++i) {
    const std::string name = fmt::format("torque_{}_nm", vehicle_.wheels[i].name);
    if (!everywhere(name)) continue;
    torque_wheels_.push_back(i);
    channels_.push_back(name);
  }
}

Eigen::VectorXd WindowComparison::vector_of(const WindowPrediction& prediction) const {
  Eigen::VectorXd values(static_cast<Eigen::Index>(channels_.size()));
  values[0] = prediction.forward_mps;
  values[1] = prediction.left_mps;
  values[2] = prediction.yaw_rate_rad_s;
  Eigen::Index k = 3;
  if (has_attitude_) {
    values[k++] = prediction.pitch_rad;
    values[k++] = prediction.roll_rad;
  }
  for (const std::size_t wheel : torque_wheels_) values[k++] = prediction.torque_nm.at(wheel);
  return values;
}

std::optional<Eigen::VectorXd> WindowComparison::measured_in(std::size_t i) const {
  const DriveWindow& window = windows_[i];
  Eigen::VectorXd values(static_cast<Eigen::Index>(channels_.size()));
  values[0] = window.forward_mps;
  values[1] = window.left_mps;
  values[2] = window.yaw_rate_rad_s;
  Eigen::Index k = 3;
  if (has_attitude_) {
    values[k++] = window.pitch_rad;
    values[k++] = window.roll_rad;
  }
  for (const std::size_t wheel : torque_wheels_) {
    values[k++] = channel_mean(drives_[window.drive], window,
                               fmt::format("torque_{}_nm", vehicle_.wheels[wheel].name));
  }
  if (!values.allFinite()) return {};
  return values;
}

bool WindowComparison::consecutive(std::size_t i) const {
  return i > 0 && windows_of_[i] == windows_of_[i - 1] + 1 &&
         windows_[windows_of_[i]].drive == windows_[windows_of_[i - 1]].drive;
}

/// No window is steady: what its mean acceleration leaves out.
double WindowComparison::acceleration_std_mps2(const WindowInput& input) {
  constexpr double kUnsteady = 0.1, kLeast_mps2 = 0.002;
  return std::hypot(kLeast_mps2, kUnsteady * input.acceleration_mps2);
}

void WindowComparison::shift(WindowInput& input, std::size_t window, std::size_t which,
                             double deviations) const {
  if (which < vehicle_.wheels.size()) {
    input.rim_rad_s.at(which) += deviations * rim_std_rad_s_[window].at(which);
  } else {
    input.acceleration_mps2 += deviations * acceleration_std_mps2(inputs_[window]);
  }
}

WindowInput WindowComparison::shifted(std::size_t i) const {
  WindowInput input = inputs_[i];
  if (shifts_.size() == 0) return input;
  for (std::size_t k = 0; k < inputs(); ++k) {
    shift(input, i, k, shifts_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)));
  }
  return input;
}

Eigen::MatrixXd WindowComparison::predicted(const VehicleDeviation& deviation,
                                            const std::vector<WindowZone>& zones,
                                            const Eigen::MatrixXd& otherwise,
                                            const std::stop_token& stop) const {
  throw_if_stopped(stop);
  Eigen::MatrixXd result = otherwise;
  for (std::size_t i = 0; i < size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    SoilNumbers numbers{};
    double share = 0;
    for (const WindowZone& zone : zones) {
      if (!(zone.share[i] > share)) continue;
      share = zone.share[i];
      numbers = zone.numbers;
    }
    const WindowInput input = shifted(i);
    const auto plain = share < 1 ? model_.predict(input, deviation) : std::nullopt;
    const auto zoned = share > 0 ? model_.predict(input, deviation, numbers) : std::nullopt;
    if ((share < 1 && !plain) || (share > 0 && !zoned)) continue;
    Eigen::VectorXd values = Eigen::VectorXd::Zero(result.cols());
    if (plain) values += (1 - share) * vector_of(*plain);
    if (zoned) values += share * vector_of(*zoned);
    result.row(row) = values;
  }
  return result;
}

std::vector<Eigen::MatrixXd> WindowComparison::of_inputs(const VehicleDeviation& deviation,
                                                         const Eigen::MatrixXd& base,
                                                         const std::stop_token& stop) const {
  std::vector<Eigen::MatrixXd> result;
  for (std::size_t k = 0; k < inputs(); ++k) {
    throw_if_stopped(stop);
    Eigen::MatrixXd change = Eigen::MatrixXd::Zero(base.rows(), base.cols());
    for (std::size_t i = 0; i < size(); ++i) {
      const WindowInput input = shifted(i);
      WindowInput further = input;
      shift(further, i, k, 1);
      const auto there = model_.predict(further, deviation);
      const auto here = model_.predict(input, deviation);
      if (there && here) {
        change.row(static_cast<Eigen::Index>(i)) = vector_of(*there) - vector_of(*here);
      }
    }
    result.push_back(std::move(change));
  }
  return result;
}

}  // namespace regoplan
