#include "drive_diagnosis/vehicle_effects.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "drive_diagnosis/robust_statistics.h"

namespace regoplan {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr std::size_t kWindowsLeast = 12;

/// A window that the model can be asked of, with what was measured in it.
struct Comparison {
  std::size_t window = 0;
  WindowInput input;
  Eigen::VectorXd measured;
};

/// A deviation of the vehicle that is asked for.
struct Trial {
  std::string id, parameter;
  double unit = 1;       ///< the parameter's size
  double prior_std = 0;  ///< in units of it
  VehicleDeviation deviation;
};

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
  constexpr double kMoving_mps = 0.05;
  if (!(std::abs(window.forward_mps) > kMoving_mps)) return {};
  WindowInput input{.x_m = window.x_m,
                    .y_m = window.y_m,
                    .yaw_rad = window.yaw_rad,
                    .acceleration_mps2 = window.acceleration_mps2,
                    .speed_mps = window.forward_mps,
                    .yaw_rate_rad_s = window.yaw_rate_rad_s};
  if (!std::isnan(window.wheel_acceleration_rad_s2)) {
    input.acceleration_mps2 = window.wheel_acceleration_rad_s2 * vehicle.wheel.radius_m;
  }
  double all = input.x_m + input.y_m + input.yaw_rad + input.yaw_rate_rad_s;
  for (std::size_t i = 0; i < vehicle.wheels.size(); ++i) {
    input.rim_rad_s.at(i) = rim_rad_s(drive, window, vehicle.wheels[i]);
    input.steer_rad.at(i) = steer_of(drive, window, vehicle, vehicle.wheels[i]);
    all += input.rim_rad_s.at(i) + input.steer_rad.at(i);
  }
  if (std::isnan(all)) return {};
  return input;
}

class Comparer {
 public:
  Comparer(const std::vector<DriveRecording>& drives, const std::vector<DriveWindow>& windows,
           const TerrainMap& map, const Vehicle& vehicle, double gravity_mps2)
      : drives_(drives),
        windows_(windows),
        map_(map),
        vehicle_(vehicle),
        model_(map, vehicle, gravity_mps2) {}

  bool collect();
  Eigen::VectorXd whitened(const Eigen::MatrixXd& by_window) const;
  std::vector<Trial> trials() const;
  /// By window and channel, what a deviation changes.
  Eigen::MatrixXd change(const VehicleDeviation& deviation) const;
  void estimate_noise();

  const std::vector<Comparison>& comparisons() const { return comparisons_; }
  const Eigen::MatrixXd& residuals() const { return residuals_; }
  bool consecutive(std::size_t i) const;  ///< whether i follows i - 1 without a gap
  std::size_t channels() const { return 2 + torque_wheels_.size(); }
  const std::vector<std::size_t>& torque_wheels() const { return torque_wheels_; }
  const std::vector<double>& noise() const { return noise_; }

 private:
  Eigen::VectorXd vector_of(const WindowPrediction& prediction) const;
  Eigen::MatrixXd innovations(const Eigen::MatrixXd& by_window) const;
  void relate_channels();

  const std::vector<DriveRecording>& drives_;
  const std::vector<DriveWindow>& windows_;
  const TerrainMap& map_;
  const Vehicle& vehicle_;
  WindowModel model_;
  std::vector<std::size_t> torque_wheels_;
  std::vector<Comparison> comparisons_;
  Eigen::MatrixXd predicted_, residuals_;
  std::vector<double> noise_, correlation_;
  Eigen::LLT<Eigen::MatrixXd> related_;  ///< of the channels' innovations
};

Eigen::VectorXd Comparer::vector_of(const WindowPrediction& prediction) const {
  Eigen::VectorXd values(static_cast<Eigen::Index>(channels()));
  values[0] = prediction.forward_mps;
  values[1] = prediction.yaw_rate_rad_s;
  Eigen::Index k = 2;
  for (const std::size_t wheel : torque_wheels_) values[k++] = prediction.torque_nm.at(wheel);
  return values;
}

bool Comparer::collect() {
  for (std::size_t i = 0; i < vehicle_.wheels.size(); ++i) {
    const std::string name = fmt::format("torque_{}_nm", vehicle_.wheels[i].name);
    const bool everywhere = std::ranges::all_of(
        drives_, [&](const DriveRecording& drive) { return drive.channel(name) != nullptr; });
    if (everywhere) torque_wheels_.push_back(i);
  }
  std::vector<Eigen::VectorXd> predicted;
  for (std::size_t i = 0; i < windows_.size(); ++i) {
    const DriveWindow& window = windows_[i];
    const DriveRecording& drive = drives_[window.drive];
    const auto input = input_of(drive, window, vehicle_);
    if (!input) continue;
    const auto prediction = model_.predict(*input, {});
    if (!prediction) continue;
    Comparison comparison{i, *input, Eigen::VectorXd(static_cast<Eigen::Index>(channels()))};
    comparison.measured[0] = window.forward_mps;
    comparison.measured[1] = window.yaw_rate_rad_s;
    Eigen::Index k = 2;
    for (const std::size_t wheel : torque_wheels_) {
      comparison.measured[k++] =
          channel_mean(drive, window, fmt::format("torque_{}_nm", vehicle_.wheels[wheel].name));
    }
    if (!comparison.measured.allFinite()) continue;
    predicted.push_back(vector_of(*prediction));
    comparisons_.push_back(std::move(comparison));
  }
  constexpr std::size_t kWindowsMost = 240;  // the contest stays within seconds
  if (comparisons_.size() > kWindowsMost) {
    comparisons_.resize(kWindowsMost);
    predicted.resize(kWindowsMost);
  }
  const auto n = static_cast<Eigen::Index>(comparisons_.size());
  predicted_.resize(n, static_cast<Eigen::Index>(channels()));
  residuals_.resize(n, static_cast<Eigen::Index>(channels()));
  for (Eigen::Index i = 0; i < n; ++i) {
    predicted_.row(i) = predicted[static_cast<std::size_t>(i)];
    residuals_.row(i) =
        comparisons_[static_cast<std::size_t>(i)].measured - predicted[static_cast<std::size_t>(i)];
  }
  return comparisons_.size() >= kWindowsLeast;
}

bool Comparer::consecutive(std::size_t i) const {
  return i > 0 && comparisons_[i].window == comparisons_[i - 1].window + 1 &&
         windows_[comparisons_[i].window].drive == windows_[comparisons_[i - 1].window].drive;
}

void Comparer::estimate_noise() {
  for (Eigen::Index k = 0; k < residuals_.cols(); ++k) {
    std::vector<double> steps, before, after;
    for (std::size_t i = 1; i < comparisons_.size(); ++i) {
      if (!consecutive(i)) continue;
      const auto at = static_cast<Eigen::Index>(i);
      steps.push_back(std::abs(residuals_(at, k) - residuals_(at - 1, k)));
      before.push_back(residuals_(at - 1, k));
      after.push_back(residuals_(at, k));
    }
    constexpr double kCorrelationMost = 0.8;
    const double rho =
        steps.size() < 5 ? 0 : std::clamp(correlation(before, after), 0.0, kCorrelationMost);
    const double step = steps.size() < 5 ? 0 : median_value(steps) / 0.6745;
    double scale = step / std::sqrt(2 * (1 - rho));
    const double least = 1e-3 * std::max(1e-3, predicted_.col(k).cwiseAbs().mean());
    scale = std::max(scale, least);
    noise_.push_back(scale);
    correlation_.push_back(rho);
  }
  relate_channels();
}

/// Each channel's innovations, by its own scale.
Eigen::MatrixXd Comparer::innovations(const Eigen::MatrixXd& by_window) const {
  Eigen::MatrixXd result(by_window.rows(), by_window.cols());
  for (Eigen::Index k = 0; k < by_window.cols(); ++k) {
    const double scale = noise_[static_cast<std::size_t>(k)];
    const double rho = correlation_[static_cast<std::size_t>(k)];
    for (Eigen::Index i = 0; i < by_window.rows(); ++i) {
      const bool follows = consecutive(static_cast<std::size_t>(i));
      const double fresh = follows ? by_window(i, k) - rho * by_window(i - 1, k) : by_window(i, k);
      result(i, k) = fresh / (scale * (follows ? std::sqrt(1 - rho * rho) : 1.0));
    }
  }
  return result;
}

/// What errs in all channels at once (an acceleration, a slope) is no independent witness.
void Comparer::relate_channels() {
  std::vector<Eigen::VectorXd> steps;
  const Eigen::MatrixXd fresh = innovations(residuals_);
  for (std::size_t i = 1; i < comparisons_.size(); ++i) {
    if (!consecutive(i)) continue;
    const auto at = static_cast<Eigen::Index>(i);
    constexpr double kFar = 3;  // a stray window must not make the relation
    steps.push_back((fresh.row(at) - fresh.row(at - 1)).transpose().cwiseMax(-kFar).cwiseMin(kFar));
  }
  const Eigen::Index n = residuals_.cols();
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(n, n);
  for (const Eigen::VectorXd& step : steps) covariance += step * step.transpose();
  const Eigen::VectorXd root = covariance.diagonal().cwiseSqrt().cwiseMax(1e-12);
  covariance = root.cwiseInverse().asDiagonal() * covariance * root.cwiseInverse().asDiagonal();
  const double shrink =
      std::min(1.0, static_cast<double>(n) / static_cast<double>(steps.size() + 1));
  related_.compute((1 - shrink) * covariance + shrink * Eigen::MatrixXd::Identity(n, n));
}

Eigen::VectorXd Comparer::whitened(const Eigen::MatrixXd& by_window) const {
  const Eigen::MatrixXd white = related_.matrixL().solve(innovations(by_window).transpose());
  return Eigen::Map<const Eigen::VectorXd>(white.data(), white.size());
}

Eigen::MatrixXd Comparer::change(const VehicleDeviation& deviation) const {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(residuals_.rows(), residuals_.cols());
  for (Eigen::Index i = 0; i < residuals_.rows(); ++i) {
    const auto there = model_.predict(comparisons_[static_cast<std::size_t>(i)].input, deviation);
    if (there) result.row(i) = vector_of(*there).transpose() - predicted_.row(i);
  }
  return result;
}

/// Everything global that may be otherwise, each with how far a sound vehicle is off.
std::vector<Trial> Comparer::trials() const {
  std::vector<Trial> trials;
  const auto add = [&trials](std::string id, std::string parameter, double unit, double prior_std,
                             const auto& set) {
    Trial trial{std::move(id), std::move(parameter), unit, prior_std, {}};
    set(trial.deviation);
    trials.push_back(std::move(trial));
  };
  std::array<double, kMaxWheels> front{};
  double front_x_m = -1e9;
  for (const WheelMount& mount : vehicle_.wheels) {
    if (mount.steered) front_x_m = std::max(front_x_m, mount.x_m);
  }
  for (std::size_t i = 0; i < vehicle_.wheels.size(); ++i) {
    const WheelMount& mount = vehicle_.wheels[i];
    add("wheel_drag", "drag_" + mount.name + "_nm", 1, 0.3,
        [i](VehicleDeviation& d) { d.wheel_drag_nm.at(i) = 1; });
    if (!mount.steered) continue;
    if (mount.x_m > front_x_m - 0.1) front.at(i) = 0.2 * kDegree;
    add("steering_offset", "steer_" + mount.name + "_deg", 0.2, 1,
        [i](VehicleDeviation& d) { d.steering_offset_rad.at(i) = 0.2 * kDegree; });
  }
  if (front_x_m > -1e8) {
    add("steering_offset", "steer_front_deg", 0.2, 0.5,
        [&](VehicleDeviation& d) { d.steering_offset_rad = front; });
  }
  add("side_drag", "drag_left_nm", 1, 0.3, [this](VehicleDeviation& d) {
    for (std::size_t i = 0; i < vehicle_.wheels.size(); ++i) {
      if (vehicle_.wheels[i].y_m > 0) d.wheel_drag_nm.at(i) = 1;
    }
  });
  add("side_drag", "drag_right_nm", 1, 0.3, [this](VehicleDeviation& d) {
    for (std::size_t i = 0; i < vehicle_.wheels.size(); ++i) {
      if (vehicle_.wheels[i].y_m < 0) d.wheel_drag_nm.at(i) = 1;
    }
  });
  add("wheel_radius", "radius_share", 0.003, 1,
      [](VehicleDeviation& d) { d.radius_share = 0.003; });
  add("payload", "mass_share", 0.02, 1, [](VehicleDeviation& d) { d.payload_share = 0.02; });
  add("motor_constant", "torque_share", 0.02, 1, [](VehicleDeviation& d) { d.motor_share = 0.02; });
  add("cg_offset", "forward_m", 0.02, 1, [](VehicleDeviation& d) { d.cg_forward_m = 0.02; });
  add("cg_offset", "left_m", 0.02, 1, [](VehicleDeviation& d) { d.cg_left_m = 0.02; });
  add("cg_offset", "up_m", 0.03, 1, [](VehicleDeviation& d) { d.cg_up_m = 0.03; });
  add("tow_drag", "drag_n", 5, 0.6, [](VehicleDeviation& d) { d.tow_drag_n = 5; });
  add("map_offset", "east_m", 0.5, 0.5, [](VehicleDeviation& d) { d.map_east_m = 0.5; });
  add("map_offset", "north_m", 0.5, 0.5, [](VehicleDeviation& d) { d.map_north_m = 0.5; });
  return trials;
}

/// Adds the stretches of soil, and the soil everywhere, as candidates.
struct Stretch {
  std::size_t column = 0, first = 0, last = 0;  ///< comparisons
};

std::vector<Stretch> add_stretches(const Comparer& comparer, const Eigen::MatrixXd& weaker,
                                   const std::vector<Comparison>& comparisons,
                                   const std::vector<DriveWindow>& windows,
                                   std::vector<EffectColumn>& columns) {
  std::vector<Stretch> stretches;
  const std::size_t n = comparisons.size();
  constexpr std::size_t kShortest = 2, kColumnsMost = 1500;
  const std::size_t longest = std::max<std::size_t>(kShortest, std::min(n / 3, kColumnsMost / n));
  for (std::size_t first = 0; first < n; ++first) {
    for (std::size_t last = first + kShortest - 1; last < std::min(n, first + longest); ++last) {
      if (windows[comparisons[first].window].drive != windows[comparisons[last].window].drive)
        break;
      Eigen::MatrixXd masked = Eigen::MatrixXd::Zero(weaker.rows(), weaker.cols());
      const auto from = static_cast<Eigen::Index>(first);
      const auto count = static_cast<Eigen::Index>(last - first + 1);
      masked.middleRows(from, count) = weaker.middleRows(from, count);
      const Eigen::VectorXd column = comparer.whitened(masked);
      if (column.norm() < 1e-9) continue;
      stretches.push_back({columns.size(), first, last});
      columns.push_back({"soil_zone", "weaker_sd", 1, 0, column});
    }
  }
  return stretches;
}

}  // namespace

std::optional<VehicleEffects> find_vehicle_effects(const std::vector<DriveRecording>& drives,
                                                   const std::vector<DriveWindow>& windows,
                                                   const TerrainMap& map, const Vehicle& vehicle,
                                                   double gravity_mps2, std::uint64_t seed,
                                                   std::stop_token stop) {
  Comparer comparer(drives, windows, map, vehicle, gravity_mps2);
  if (!comparer.collect()) return {};
  comparer.estimate_noise();
  VehicleEffects result{.windows = static_cast<int>(comparer.comparisons().size()),
                        .channels = {"speed_mps", "yaw_rate_rad_s"},
                        .noise = comparer.noise(),
                        .has_torque = !comparer.torque_wheels().empty()};
  for (const std::size_t wheel : comparer.torque_wheels()) {
    result.channels.push_back(fmt::format("torque_{}_nm", vehicle.wheels[wheel].name));
  }
  std::vector<EffectColumn> columns;
  for (const Trial& trial : comparer.trials()) {
    if (stop.stop_requested()) return {};
    const Eigen::VectorXd column = comparer.whitened(comparer.change(trial.deviation));
    if (column.norm() < 1e-9) continue;  // these drives do not feel it
    columns.push_back({trial.id, trial.parameter, trial.unit, trial.prior_std, column});
  }
  VehicleDeviation weak;
  weak.weaker_soil = 1;
  const Eigen::MatrixXd weaker = comparer.change(weak);
  columns.push_back({"soil", "weaker_sd", 1, 1, comparer.whitened(weaker)});
  const std::vector<Stretch> stretches =
      add_stretches(comparer, weaker, comparer.comparisons(), windows, columns);
  const Eigen::VectorXd data = comparer.whitened(comparer.residuals());
  constexpr int kEffectsMost = 3;
  result.found = find_effects(data, columns, kEffectsMost, seed);

  for (const EffectFound& effect : result.found) {
    const auto chosen = std::ranges::find(stretches, effect.effect, &Stretch::column);
    if (chosen == stretches.end()) {
      result.zones.emplace_back();
      continue;
    }
    const auto& comparisons = comparer.comparisons();
    const auto window_at = [&](std::size_t i) -> const DriveWindow& {
      return windows[comparisons[i].window];
    };
    SoilZoneFound zone{
        .drive = window_at(chosen->first).drive,
        .first = comparisons[chosen->first].window,
        .last = comparisons[chosen->last].window,
        .start_s = {window_at(chosen->first).start_s, window_at(chosen->first).start_s},
        .end_s = {window_at(chosen->last).end_s, window_at(chosen->last).end_s}};
    for (const std::size_t alike : effect.alike) {
      const auto other = std::ranges::find(stretches, alike, &Stretch::column);
      if (other == stretches.end()) continue;
      if (other->first > chosen->last || other->last < chosen->first) continue;
      zone.start_s = {std::min(zone.start_s[0], window_at(other->first).start_s),
                      std::max(zone.start_s[1], window_at(other->first).start_s)};
      zone.end_s = {std::min(zone.end_s[0], window_at(other->last).end_s),
                    std::max(zone.end_s[1], window_at(other->last).end_s)};
    }
    const auto soil_of = [&](std::size_t i) {
      return map.soil_index(comparisons[i].input.x_m, comparisons[i].input.y_m);
    };
    zone.at_border = (chosen->first > 0 && soil_of(chosen->first - 1) != soil_of(chosen->first)) ||
                     (chosen->last + 1 < comparisons.size() &&
                      soil_of(chosen->last + 1) != soil_of(chosen->last));
    result.zones.push_back(zone);
  }
  Eigen::MatrixXd left = comparer.residuals();
  for (std::size_t k = 0; k < comparer.channels(); ++k) {
    result.rms.push_back(std::sqrt(left.col(static_cast<Eigen::Index>(k)).squaredNorm() /
                                   static_cast<double>(left.rows())));
  }
  for (EffectColumn& column : columns) column.column.resize(0);
  result.columns = std::move(columns);
  return result;
}

}  // namespace regoplan
