#include "diagnosis/bed/discrepancy.h"

#include <cmath>
#include <mutex>
#include <utility>

namespace regoplan {
namespace {

double squared(double x) {
  return x * x;
}

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
    const auto add = [&all](Sides sides, double least) {
      for (const double amplitude : kDiscrepancyAmplitudes) {
        if (amplitude < least) continue;
        for (std::size_t k = 0; k < discrepancy_scales().size(); ++k) {
          all.push_back({amplitude, k, sides});
        }
      }
    };
    add(Sides::kMirrored, kDiscrepancyAmplitudes[1]);
    add(Sides::kApart, kLeastApart);
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

ConditionsAt conditions_of(const TestBed& bed, const ChannelData& data) {
  ConditionsAt conditions;
  for (const std::size_t k : data.conditions) conditions.push_back(&bed.conditions[k]);
  return conditions;
}

Eigen::MatrixXd discrepancy_kernels(const DiscrepancyScales& scales, Channel channel,
                                    const ConditionsAt& a, const ConditionsAt& b, Sides sides) {
  Eigen::MatrixXd kernels(static_cast<Eigen::Index>(a.size()), static_cast<Eigen::Index>(b.size()));
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t k = 0; k < b.size(); ++k) {
      kernels(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
          discrepancy_kernel(scales, channel, *a[i], *b[k], sides);
    }
  }
  return kernels;
}

struct Discrepancy::OfChannel {
  /// Made when it is asked for first, by whichever thread asks.
  template <class Value>
  struct Lazy {
    std::once_flag once;
    Value value;

    template <class Make>
    const Value& made_by(Make make) {
      std::call_once(once, [&] { value = make(); });
      return value;
    }
  };

  Channel channel;
  double scale = 0;
  Eigen::MatrixXd noise;
  std::vector<Condition> conditions;
  std::vector<Lazy<Eigen::MatrixXd>> kernels{2 * discrepancy_scales().size()};
  std::vector<Lazy<ChannelCovariance>> covariances{discrepancy_settings().size()};

  OfChannel(const TestBed& bed, const ChannelData& data)
      : channel(data.channel), scale(data.scale), noise(data.noise) {
    for (const Condition* at : conditions_of(bed, data)) conditions.push_back(*at);
  }

  const Eigen::MatrixXd& kernel(const DiscrepancySetting& setting) {
    const std::size_t sides = setting.sides == Sides::kApart ? 1 : 0;
    return kernels[2 * setting.scales + sides].made_by([&] {
      ConditionsAt at;
      for (const Condition& condition : conditions) at.push_back(&condition);
      return discrepancy_kernels(discrepancy_scales()[setting.scales], channel, at, at,
                                 setting.sides);
    });
  }

  ChannelCovariance covariance(const DiscrepancySetting& setting) {
    ChannelCovariance covariance;
    Eigen::MatrixXd whole = noise;
    if (setting.amplitude > 0) {
      covariance.discrepancy = squared(setting.amplitude * scale) * kernel(setting);
      whole += covariance.discrepancy;
    }
    covariance.factor.compute(whole);
    covariance.log_determinant = 2 * covariance.factor.matrixLLT().diagonal().array().log().sum();
    return covariance;
  }
};

Discrepancy::Discrepancy(const TestBed& bed) {
  for (const ChannelData& data : bed.channels) {
    channels_.push_back(std::make_shared<OfChannel>(bed, data));
  }
}

const ChannelCovariance& Discrepancy::at(std::size_t channel, std::size_t setting) const {
  OfChannel& of_channel = *channels_[channel];
  return of_channel.covariances[setting].made_by(
      [&] { return of_channel.covariance(discrepancy_settings()[setting]); });
}

}  // namespace regoplan
