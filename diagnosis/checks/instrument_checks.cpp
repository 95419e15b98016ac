#include "diagnosis/checks/instrument_checks.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "diagnosis/recording/thresholds.h"

namespace regoplan {
namespace {

struct Value {
  double mean, variance;
};

std::optional<Value> value_at(const TestBed& bed, Channel channel, std::size_t condition) {
  for (const ChannelData& data : bed.channels) {
    if (data.channel != channel) continue;
    for (std::size_t i = 0; i < data.conditions.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      if (data.conditions[i] == condition) return Value{data.mean[row], data.noise(row, row)};
    }
  }
  return std::nullopt;
}

bool mirrored(const Condition& a, const Condition& b) {
  return std::abs(a.slip_ratio - b.slip_ratio) < 0.01 &&
         std::abs(a.slip_angle_rad + b.slip_angle_rad) < 0.009 && a.slip_angle_rad > 0.02 &&
         std::abs(std::log(a.load_n / b.load_n)) < 0.05 && a.conditions.pass == b.conditions.pass &&
         a.conditions.speed_mps == b.conditions.speed_mps;
}

/// Weighted mean of values that ought to be 0.
struct Mean {
  double sum = 0, weights = 0;
  int count = 0;

  void add(double value, double variance) {
    sum += value / variance;
    weights += 1 / variance;
    ++count;
  }
  double value() const { return sum / weights; }
  double deviations() const { return count == 0 ? 0 : std::abs(sum) / std::sqrt(weights); }
};

}  // namespace

std::vector<std::string> instrument_checks(const CondensedRecording& recording) {
  const TestBed& bed = recording.bed;
  std::vector<std::string> findings;
  for (const ChannelData& data : bed.channels) {
    if (data.channel == Channel::kRutLeft || data.channel == Channel::kRutRight) continue;
    Mean difference;
    for (std::size_t a = 0; a < bed.conditions.size(); ++a) {
      for (std::size_t b = 0; b < bed.conditions.size(); ++b) {
        if (!mirrored(bed.conditions[a], bed.conditions[b])) continue;
        const auto left = value_at(bed, data.channel, a), right = value_at(bed, data.channel, b);
        if (!left || !right) continue;
        const double odd = data.channel == Channel::kFy ? 1 : -1;
        difference.add(left->mean + odd * right->mean, left->variance + right->variance);
      }
    }
    if (difference.deviations() > Thresholds::kImpossible_deviations) {
      findings.push_back(fmt::format(
          "{} is not mirror-symmetric in the slip angle: {:+.3g} in {} "
          "pairs, {:.1f} standard errors; no level soil does that",
          name(data.channel), difference.value(), difference.count, difference.deviations()));
    }
  }
  Mean straight, power;
  for (std::size_t k = 0; k < bed.conditions.size(); ++k) {
    const Condition& at = bed.conditions[k];
    if (const auto fy = value_at(bed, Channel::kFy, k); fy && std::abs(at.slip_angle_rad) < 0.002) {
      straight.add(fy->mean, fy->variance);
    }
    const auto fx = value_at(bed, Channel::kFx, k);
    const auto torque = value_at(bed, Channel::kTorque, k);
    if (!fx || !torque || at.slip_ratio < 0) continue;
    // per radian turned: T against Fx r (1 - s)
    const double arm = bed.setup.wheel.radius_m * (1 - at.slip_ratio);
    const double lost = torque->mean - fx->mean * arm;
    const double variance = torque->variance + fx->variance * arm * arm;
    if (lost < -Thresholds::kImpossible_deviations * std::sqrt(variance)) power.add(lost, variance);
  }
  if (straight.deviations() > Thresholds::kImpossible_deviations) {
    findings.push_back(
        fmt::format("fy_n straight ahead is {:+.3g} N, {:.1f} standard errors from 0",
                    straight.value(), straight.deviations()));
  }
  if (power.count > 0) {
    findings.push_back(
        fmt::format("in {} conditions the wheel pulls with more power than its axle "
                    "takes (T w < Fx v)",
                    power.count));
  }
  return findings;
}

}  // namespace regoplan
