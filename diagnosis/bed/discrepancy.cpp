#include "diagnosis/bed/discrepancy.h"

#include <cmath>

#include "terramech/basics/interruption.h"

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
    for (const double amplitude : {0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0}) {
      for (std::size_t k = 0; k < discrepancy_scales().size(); ++k) all.push_back({amplitude, k});
    }
    return all;
  }();
  return settings;
}

double discrepancy_kernel(const DiscrepancyScales& scales, Channel channel, const Condition& a,
                          const Condition& b) {
  const double from = std::abs(a.slip_angle_rad), to = std::abs(b.slip_angle_rad);
  const auto along_angle = [&](double distance) {
    return std::exp(-squared(distance / scales.slip_angle_rad) / 2);
  };
  double angle = along_angle(from - to);
  if (channel == Channel::kFy) {
    const double side = side_of(a.slip_angle_rad) * side_of(b.slip_angle_rad);
    if (side == 0) return 0;
    angle = side * (angle - along_angle(from + to));
  }
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

Discrepancy::Discrepancy(const TestBed& bed) {
  for (const ChannelData& data : bed.channels) {
    const Eigen::Index n = data.mean.size();
    std::vector<Eigen::MatrixXd> kernels;
    for (const DiscrepancyScales& scales : discrepancy_scales()) {
      Eigen::MatrixXd& kernel = kernels.emplace_back(n, n);
      for (Eigen::Index i = 0; i < n; ++i) {
        for (Eigen::Index k = 0; k < n; ++k) {
          kernel(i, k) = discrepancy_kernel(
              scales, data.channel, bed.conditions[data.conditions[static_cast<std::size_t>(i)]],
              bed.conditions[data.conditions[static_cast<std::size_t>(k)]]);
        }
      }
    }
    std::vector<ChannelCovariance>& all = channels_.emplace_back();
    for (const DiscrepancySetting& setting : discrepancy_settings()) {
      throw_if_stopped(bed.stop);
      ChannelCovariance& at = all.emplace_back();
      Eigen::MatrixXd whole = data.noise;
      if (setting.amplitude > 0) {
        at.discrepancy = squared(setting.amplitude * data.scale) * kernels[setting.scales];
        whole += at.discrepancy;
      }
      at.factor.compute(whole);
      at.log_determinant = 2 * at.factor.matrixLLT().diagonal().array().log().sum();
    }
  }
}

}  // namespace regoplan
