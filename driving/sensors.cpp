#include "driving/sensors.h"

#include <algorithm>
#include <cmath>

namespace regoplan {
namespace {

constexpr double kLongestLatency_s = 10;

std::mt19937_64 stream(std::uint64_t seed, std::uint64_t number) {
  std::seed_seq sequence{seed, number};
  return std::mt19937_64(sequence);
}

double normal(std::mt19937_64& random) {
  return std::normal_distribution<double>()(random);
}

double uniform(std::mt19937_64& random) {
  return std::uniform_real_distribution<double>()(random);
}

std::vector<double> of_wheels(const std::vector<WheelNow>& wheels, double WheelNow::*what) {
  std::vector<double> values;
  for (const WheelNow& wheel : wheels) values.push_back(wheel.*what);
  return values;
}

}  // namespace

ScatterWalk::ScatterWalk(const GroundScatter& scatter, std::uint64_t seed)
    : scatter_(scatter), random_(stream(seed, 100)) {
  for (double& value : values_) value = normal(random_);
}

void ScatterWalk::advance(double way_m) {
  const double kept = std::exp(-std::abs(way_m) / scatter_.correlation_m);
  const double fresh = std::sqrt(1 - kept * kept);
  for (double& value : values_) value = kept * value + fresh * normal(random_);
}

Sensors::Sensors(const SensorSuite& suite, const Vehicle& vehicle, std::uint64_t seed)
    : radius_m_(vehicle.wheel.radius_m), steer_noise_rad_(suite.steer_noise_rad) {
  std::uint64_t number = 0;
  const auto line = [&](const std::optional<SensorChannel>& channel) {
    return Line{.channel = channel, .due_s = 0, .last = {}, .random = stream(seed, ++number)};
  };
  position_ = line(suite.position);
  yaw_ = line(suite.yaw);
  attitude_ = line(suite.attitude);
  wheel_speed_ = line(suite.wheel_speed);
  torque_ = line(suite.torque);
  sinkage_ = line(suite.sinkage);
  yaw_rate_ = line(suite.yaw_rate);
  steer_random_ = stream(seed, ++number);
}

const SensedTruth& Sensors::at(double time_s) const {
  const auto then = std::ranges::min_element(
      past_, {}, [&](const SensedTruth& past) { return std::abs(past.time_s - time_s); });
  return *then;
}

std::optional<std::vector<double>> Sensors::sampled(Line& line, double time_s,
                                                    const std::vector<double>& values,
                                                    bool shares) {
  constexpr double kRounding_s = 1e-9;
  line.fresh = false;
  if (!line.channel || time_s < line.due_s - kRounding_s) return std::nullopt;
  const SensorChannel& channel = *line.channel;
  line.due_s = std::max(line.due_s + 1 / channel.rate_hz, time_s - 1 / channel.rate_hz);
  // Always as many numbers are drawn, so that one fault does not shift another's chance.
  const bool dropped = uniform(line.random) < channel.dropped_share;
  const bool stale = uniform(line.random) < channel.stale_share;
  std::vector<double> measured;
  for (const double value : values) {
    const double unit = shares ? value : 1;
    double sample = value + unit * (channel.bias + channel.noise * normal(line.random));
    if (channel.quantum > 0) sample = channel.quantum * std::round(sample / channel.quantum);
    measured.push_back(sample);
  }
  if (dropped) return std::nullopt;
  if (stale && !line.last.empty()) return line.last;
  line.last = measured;
  line.fresh = true;
  return measured;
}

SensedRow Sensors::sample(const SensedTruth& truth) {
  past_.push_back(truth);
  while (past_.front().time_s < truth.time_s - kLongestLatency_s) past_.pop_front();
  const auto then = [&](const Line& line) -> const SensedTruth& {
    return at(truth.time_s - (line.channel ? line.channel->latency_s : 0));
  };
  const double t = truth.time_s;
  SensedRow row{.time_s = t};
  {
    const VehicleState& state = then(position_).state;
    if (const auto xy = sampled(position_, t, {state.x_m, state.y_m}, false)) {
      row.x_m = xy->at(0);
      row.y_m = xy->at(1);
    }
  }
  if (const auto yaw = sampled(yaw_, t, {then(yaw_).state.yaw_rad}, false)) {
    row.yaw_rad = yaw->at(0);
  }
  const SensedTruth& tilted = then(attitude_);
  if (const auto angles = sampled(attitude_, t, {tilted.roll_rad, tilted.pitch_rad}, false)) {
    row.roll_rad = angles->at(0);
    row.pitch_rad = angles->at(1);
  }
  const double rate = then(yaw_rate_).state.motion.yaw_rate_rad_s;
  if (const auto measured = sampled(yaw_rate_, t, {rate}, false))
    row.yaw_rate_rad_s = measured->at(0);
  std::vector<double> turning = of_wheels(then(wheel_speed_).wheels, &WheelNow::rim_speed_mps);
  for (double& speed : turning) speed /= radius_m_;
  if (const auto speeds = sampled(wheel_speed_, t, turning, true)) row.wheel_speed_rad_s = *speeds;
  if (const auto torques =
          sampled(torque_, t, of_wheels(then(torque_).wheels, &WheelNow::torque_nm), true)) {
    row.torque_nm = *torques;
  }
  if (const auto depths =
          sampled(sinkage_, t, of_wheels(then(sinkage_).wheels, &WheelNow::sinkage_m), false)) {
    row.sinkage_m = *depths;
  }
  for (const WheelNow& wheel : truth.wheels) {
    row.steer_rad.push_back(wheel.steer_rad + steer_noise_rad_ * normal(steer_random_));
  }
  return row;
}

std::optional<PoseFix> Sensors::fix(const SensedRow& row) const {
  const bool placed = position_.fresh, headed = yaw_.fresh;
  if (!placed && !headed) return std::nullopt;
  PoseFix fix{.time_s = row.time_s - (placed ? position_ : yaw_).channel->latency_s};
  if (placed) {
    fix.x_m = row.x_m;
    fix.y_m = row.y_m;
  }
  if (headed) fix.yaw_rad = row.yaw_rad;
  return fix;
}

}  // namespace regoplan
