#include "diagnosis/bed/discrepancy.h"

#include <cmath>
#include <map>
#include <mutex>
#include <utility>

#include "terramech/basics/interruption.h"

namespace regoplan {
namespace {

double squared(double x) {
  return x * x;
}

constexpr Sides kSides[] = {Sides::kMirrored, Sides::kApart};

/// Sign of the slip angle; runs straight ahead are straight to within half a degree.
double side_of(double slip_angle_rad) {
  constexpr double kStraight_rad = 0.0087;
  if (std::abs(slip_angle_rad) < kStraight_rad) return 0;
  return slip_angle_rad > 0 ? 1 : -1;
}

/// The part of the kernel along the slip angle.
double along_slip_angle(const DiscrepancyScales& scales, Channel channel, double a_rad,
                        double b_rad, Sides sides) {
  const auto along = [&](double distance_rad) {
    return std::exp(-squared(distance_rad / scales.slip_angle_rad) / 2);
  };
  if (sides == Sides::kApart) return along(a_rad - b_rad);
  const double from_rad = std::abs(a_rad), to_rad = std::abs(b_rad);
  if (channel != Channel::kFy) return along(from_rad - to_rad);
  return side_of(a_rad) * side_of(b_rad) * (along(from_rad - to_rad) - along(from_rad + to_rad));
}

}  // namespace

const std::vector<DiscrepancyScales>& discrepancy_scales() {
  static const std::vector<DiscrepancyScales> scales{
      {.slip = 0.15, .slip_angle_rad = 0.14, .log_load = 0.5},
      {.slip = 0.35, .slip_angle_rad = 0.3, .log_load = 1},
      {.slip = 0.8, .slip_angle_rad = 0.7, .log_load = 2}};
  return scales;
}

const std::vector<DiscrepancySetting>& discrepancy_settings() {
  static const std::vector<DiscrepancySetting> settings = [] {
    std::vector<DiscrepancySetting> all{{}};
    constexpr double kLeastApart = 2;
    for (const Sides sides : kSides) {
      for (const double amplitude : {0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0}) {
        if (sides == Sides::kApart && amplitude < kLeastApart) continue;
        for (std::size_t k = 0; k < discrepancy_scales().size(); ++k) {
          all.push_back({amplitude, k, sides});
        }
      }
    }
    return all;
  }();
  return settings;
}

double discrepancy_kernel(const DiscrepancyScales& scales, Channel channel, const Condition& a,
                          const Condition& b, Sides sides) {
  const double angle = along_slip_angle(scales, channel, a.slip_angle_rad, b.slip_angle_rad, sides);
  if (angle == 0) return 0;
  double d = squared((a.slip_ratio - b.slip_ratio) / scales.slip) +
             squared(std::log(a.load_n / b.load_n) / scales.log_load);
  const WheelConditions& p = a.conditions;
  const WheelConditions& q = b.conditions;
  d += squared(std::log(static_cast<double>(p.pass) / q.pass));
  if (p.speed_mps > 0 && q.speed_mps > 0) d += squared(std::log(p.speed_mps / q.speed_mps) / 1.5);
  constexpr double kWhen = 0.5;  // share of the recording's course, where time is a place
  d += squared((a.when - b.when) / kWhen);
  return angle * std::exp(-d / 2);
}

namespace {

Eigen::MatrixXd kernel_of(const TestBed& bed, const ChannelData& data,
                          const DiscrepancyScales& scales, Sides sides) {
  const auto at = [&](Eigen::Index i) -> const Condition& {
    return bed.conditions[data.conditions[static_cast<std::size_t>(i)]];
  };
  const Eigen::Index n = data.mean.size();
  Eigen::MatrixXd kernel(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index k = 0; k < n; ++k) {
      kernel(i, k) = discrepancy_kernel(scales, data.channel, at(i), at(k), sides);
    }
  }
  return kernel;
}

}  // namespace

struct Discrepancy::OfChannel {
  struct Made {
    std::once_flag once;
    ChannelCovariance covariance;
  };
  double scale = 0;
  Eigen::MatrixXd noise;
  std::map<Sides, std::vector<Eigen::MatrixXd>> kernels;  // one for each of the scales
  std::vector<Made> made{discrepancy_settings().size()};
};

Discrepancy::Discrepancy(const TestBed& bed) {
  for (const ChannelData& data : bed.channels) {
    throw_if_stopped(bed.stop);
    auto of_channel = std::make_shared<OfChannel>();
    of_channel->scale = data.scale;
    of_channel->noise = data.noise;
    for (const Sides sides : kSides) {
      for (const DiscrepancyScales& scales : discrepancy_scales()) {
        of_channel->kernels[sides].push_back(kernel_of(bed, data, scales, sides));
      }
    }
    channels_.push_back(std::move(of_channel));
  }
}

const ChannelCovariance& Discrepancy::at(std::size_t channel, std::size_t setting) const {
  OfChannel& of_channel = *channels_[channel];
  OfChannel::Made& made = of_channel.made[setting];
  std::call_once(made.once, [&] {
    const DiscrepancySetting& with = discrepancy_settings()[setting];
    ChannelCovariance& at = made.covariance;
    Eigen::MatrixXd whole = of_channel.noise;
    if (with.amplitude > 0) {
      at.discrepancy = squared(with.amplitude * of_channel.scale) *
                       of_channel.kernels.at(with.sides)[with.scales];
      whole += at.discrepancy;
    }
    at.factor.compute(whole);
    at.log_determinant = 2 * at.factor.matrixLLT().diagonal().array().log().sum();
  });
  return made.covariance;
}

}  // namespace regoplan
