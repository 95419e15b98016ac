#include "diagnosis/fit/unnamed_correction.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "diagnosis/bed/span.h"
#include "diagnosis/fit/carried_surface.h"
#include "terramech/basics/interruption.h"

namespace regoplan {
namespace {

constexpr double kMargin = 0.1;  // of the measured range, beyond either end

std::array<double, 2> with_margin(const Span& span, double least, double min, double max) {
  const double margin = std::max(kMargin * span.width(), least);
  return {std::max(span.low - margin, min), std::min(span.high + margin, max)};
}

}  // namespace

std::vector<std::size_t> remainder_settings(const FitProblem& problem, const CandidateFit& fit) {
  const TestBed& bed = problem.bed;
  const Eigen::VectorXd left = bed.measured() - fit.prediction;
  std::vector<std::size_t> best;
  double best_score = -INFINITY;
  for (std::size_t scales = 0; scales < discrepancy_scales().size(); ++scales) {
    std::vector<std::size_t> chosen;
    double sum = 0;
    for (std::size_t c = 0; c < bed.channels.size(); ++c) {
      const Eigen::VectorXd part = left.segment(bed.offset(c), bed.channels[c].mean.size());
      double top = -INFINITY;
      std::size_t at = 0;
      throw_if_stopped(bed.stop);
      for (std::size_t k = 0; k < discrepancy_settings().size(); ++k) {
        const DiscrepancySetting& setting = discrepancy_settings()[k];
        if (setting.sides == Sides::kApart) continue;
        if (setting.amplitude > 0 && setting.scales != scales) continue;
        const ChannelCovariance& covariance = problem.discrepancy.at(c, k);
        const double score = -0.5 * (covariance.factor.matrixL().solve(part).squaredNorm() +
                                     covariance.log_determinant);
        if (score > top) {
          top = score;
          at = k;
        }
      }
      chosen.push_back(at);
      sum += top;
    }
    if (sum > best_score) {
      best_score = sum;
      best = chosen;
    }
  }
  return best;
}

GenericCorrection unnamed_correction(const FitProblem& problem, const CandidateFit& fit,
                                     const std::vector<std::size_t>& settings,
                                     const std::vector<double>& share) {
  const TestBed& bed = problem.bed;
  GenericCorrection correction;
  for (const std::size_t k : settings) {
    const DiscrepancyScales& scales = discrepancy_scales()[discrepancy_settings()[k].scales];
    if (discrepancy_settings()[k].amplitude == 0) continue;
    correction.slip_scale = scales.slip;
    correction.slip_angle_scale_rad = scales.slip_angle_rad;
    correction.log_load_scale = scales.log_load;
  }
  Span slip, angle, log_load;
  for (const Condition& at : bed.conditions) {
    slip.take(at.slip_ratio);
    angle.take(std::abs(at.slip_angle_rad));
    log_load.take(std::log(at.load_n));
    correction.nodes.push_back({.slip_ratio = at.slip_ratio,
                                .slip_angle_rad = std::abs(at.slip_angle_rad),
                                .load_n = at.load_n});
  }
  // what was measured counts in full; the fade lies outside
  correction.slip_ratio_region = with_margin(slip, 0.02, -1, 1);
  correction.slip_angle_rad_region = with_margin(angle, 0.02, 0, std::numbers::pi / 2);
  const auto [lightest, heaviest] = with_margin(log_load, 0.05, -INFINITY, INFINITY);
  correction.load_n_region = {std::exp(lightest), std::exp(heaviest)};
  correction.fade_share = kMargin / (1 + 2 * kMargin);
  const Eigen::VectorXd left = bed.measured() - fit.prediction;
  const CarriedAt carried = CarriedAt::of(bed);
  for (std::size_t c = 0; c < bed.channels.size(); ++c) {
    const ChannelData& data = bed.channels[c];
    if (discrepancy_settings()[settings[c]].amplitude == 0) continue;
    const CarriedSurface surface(bed, c, settings[c], problem.discrepancy,
                                 left.segment(bed.offset(c), data.mean.size()), carried);
    const Eigen::VectorXd height = share[c] * surface.heights();
    for (std::size_t i = 0; i < data.conditions.size(); ++i) {
      GenericCorrection::Node& node = correction.nodes[data.conditions[i]];
      const double h = height[static_cast<Eigen::Index>(i)];
      const bool left_side = bed.conditions[data.conditions[i]].slip_angle_rad > 0;
      if (data.channel == Channel::kFx) node.fx_n = h;
      if (data.channel == Channel::kFy) node.fy_n = left_side ? h : -h;
      if (data.channel == Channel::kTorque) node.torque_nm = h;
      if (data.channel == Channel::kSinkage) node.sinkage_m = h;
    }
  }
  std::erase_if(correction.nodes, [](const GenericCorrection::Node& node) {
    return node.fx_n == 0 && node.fy_n == 0 && node.torque_nm == 0 && node.sinkage_m == 0;
  });
  return correction;
}

}  // namespace regoplan
