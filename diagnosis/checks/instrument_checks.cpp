#include "diagnosis/checks/instrument_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <utility>

#include "diagnosis/recording/thresholds.h"

namespace regoplan {
namespace {

std::optional<Eigen::Index> row_of(const ChannelData& data, std::size_t condition) {
  const auto found = std::ranges::find(data.conditions, condition);
  if (found == data.conditions.end()) return std::nullopt;
  return found - data.conditions.begin();
}

struct Value {
  double mean, variance;
};

std::optional<Value> value_at(const TestBed& bed, Channel channel, std::size_t condition) {
  for (const ChannelData& data : bed.channels) {
    if (data.channel != channel) continue;
    const auto row = row_of(data, condition);
    if (row) return Value{data.mean[*row], data.noise(*row, *row)};
  }
  return std::nullopt;
}

bool mirrored(const Condition& a, const Condition& b) {
  return std::abs(a.slip_ratio - b.slip_ratio) < 0.01 &&
         std::abs(a.slip_angle_rad + b.slip_angle_rad) < 0.009 && a.slip_angle_rad > 0.02 &&
         std::abs(std::log(a.load_n / b.load_n)) < 0.05 && a.conditions.pass == b.conditions.pass &&
         a.conditions.speed_mps == b.conditions.speed_mps;
}

/// Weighted mean of sums of a channel's values that ought to be 0. What a day does to all values
/// alike does not average out.
class MeanOfSums {
 public:
  explicit MeanOfSums(const ChannelData& data)
      : data_(data), factors_(Eigen::VectorXd::Zero(data.mean.size())) {}

  void add(std::initializer_list<std::pair<Eigen::Index, double>> rows_and_factors) {
    double variance = 0;
    for (const auto& [row, factor] : rows_and_factors) variance += data_.noise(row, row);
    for (const auto& [row, factor] : rows_and_factors) factors_[row] += factor / variance;
    weights_ += 1 / variance;
    ++count_;
  }
  int count() const { return count_; }
  double value() const { return factors_.dot(data_.mean) / weights_; }
  double deviations() const {
    if (count_ == 0) return 0;
    return std::abs(factors_.dot(data_.mean)) / std::sqrt(factors_.dot(data_.noise * factors_));
  }

 private:
  const ChannelData& data_;
  Eigen::VectorXd factors_;
  double weights_ = 0;
  int count_ = 0;
};

/// Values whose sum or difference at mirrored slip angles ought to be 0.
MeanOfSums asymmetry_of(const TestBed& bed, const ChannelData& data) {
  const double odd = data.channel == Channel::kFy ? 1 : -1;
  MeanOfSums asymmetry(data);
  for (std::size_t a = 0; a < bed.conditions.size(); ++a) {
    for (std::size_t b = 0; b < bed.conditions.size(); ++b) {
      if (!mirrored(bed.conditions[a], bed.conditions[b])) continue;
      const auto left = row_of(data, a), right = row_of(data, b);
      if (left && right) asymmetry.add({{*left, 1.0}, {*right, odd}});
    }
  }
  return asymmetry;
}

/// Side force where the wheel runs straight ahead.
MeanOfSums straight_ahead(const TestBed& bed, const ChannelData& side_force) {
  MeanOfSums straight(side_force);
  for (std::size_t i = 0; i < side_force.conditions.size(); ++i) {
    if (std::abs(bed.conditions[side_force.conditions[i]].slip_angle_rad) < 0.002) {
      straight.add({{static_cast<Eigen::Index>(i), 1.0}});
    }
  }
  return straight;
}

/// Conditions in which the wheel pulls with more power than its axle takes.
int gains_of_power(const TestBed& bed) {
  int count = 0;
  for (std::size_t k = 0; k < bed.conditions.size(); ++k) {
    const Condition& at = bed.conditions[k];
    const auto fx = value_at(bed, Channel::kFx, k);
    const auto torque = value_at(bed, Channel::kTorque, k);
    if (!fx || !torque || at.slip_ratio < 0) continue;
    // per radian turned: T against Fx r (1 - s)
    const double arm = bed.setup.wheel.radius_m * (1 - at.slip_ratio);
    const double lost = torque->mean - fx->mean * arm;
    const double variance = torque->variance + fx->variance * arm * arm;
    if (lost < -Thresholds::kImpossible_deviations * std::sqrt(variance)) ++count;
  }
  return count;
}

}  // namespace

std::vector<std::string> instrument_checks(const CondensedRecording& recording) {
  const TestBed& bed = recording.bed;
  std::vector<std::string> findings;
  for (const ChannelData& data : bed.channels) {
    if (data.channel == Channel::kRutLeft || data.channel == Channel::kRutRight) continue;
    const MeanOfSums asymmetry = asymmetry_of(bed, data);
    if (asymmetry.deviations() > Thresholds::kImpossible_deviations) {
      findings.push_back(fmt::format(
          "{} is not mirror-symmetric in the slip angle: {:+.3g} in {} "
          "pairs, {:.1f} standard errors; no level soil does that",
          name(data.channel), asymmetry.value(), asymmetry.count(), asymmetry.deviations()));
    }
  }
  for (const ChannelData& data : bed.channels) {
    if (data.channel != Channel::kFy) continue;
    const MeanOfSums straight = straight_ahead(bed, data);
    if (straight.deviations() > Thresholds::kImpossible_deviations) {
      findings.push_back(
          fmt::format("fy_n straight ahead is {:+.3g} N, {:.1f} standard errors from 0",
                      straight.value(), straight.deviations()));
    }
  }
  if (const int count = gains_of_power(bed); count > 0) {
    findings.push_back(
        fmt::format("in {} conditions the wheel pulls with more power than its axle "
                    "takes (T w < Fx v)",
                    count));
  }
  return findings;
}

}  // namespace regoplan
