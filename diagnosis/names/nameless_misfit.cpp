#include "diagnosis/names/nameless_misfit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "diagnosis/bed/whitening.h"

namespace regoplan {
namespace {

/// So many that one in forty, which decides claims, is five of them.
constexpr std::size_t kWorlds = 199;

/// Standard deviations of the logarithm of a bearing modulus that has no law.
constexpr std::array kSinkageSpreads{0.25, 0.5, 1.0};

/// Where evidence for a smooth misfit finds no longer scale than these, it may have one.
DiscrepancyScales beyond_the_longest() {
  const DiscrepancyScales& longest = discrepancy_scales().back();
  return {.slip = 2 * longest.slip,
          .slip_angle_rad = 2 * longest.slip_angle_rad,
          .log_load = 2 * longest.log_load};
}

/// Factors of the covariances, noise and misfit, of worlds whose misfit is as large as this setting
/// says and as smooth or smoother.
std::vector<Eigen::LLT<Eigen::MatrixXd>> nameless_covariances(const TestBed& bed,
                                                              const ChannelData& data,
                                                              std::size_t setting) {
  const DiscrepancySetting& found = discrepancy_settings()[setting];
  if (found.amplitude == 0) return {Eigen::LLT<Eigen::MatrixXd>(data.noise)};
  const double deviation = found.amplitude * data.scale;
  const ConditionsAt at = conditions_of(bed, data);
  std::vector<DiscrepancyScales> all = discrepancy_scales();
  all.push_back(beyond_the_longest());
  std::vector<Eigen::LLT<Eigen::MatrixXd>> factors;
  for (std::size_t k = found.scales; k < all.size(); ++k) {
    factors.emplace_back(data.noise +
                         deviation * deviation *
                             discrepancy_kernels(all[k], data.channel, at, at, found.sides));
  }
  return factors;
}

/// What a bearing modulus that varies smoothly over the conditions does, a column a function, by
/// its logarithm: sinkages without a law of their own that the forces follow.
Eigen::MatrixXd sinkage_columns(const CalibratedRecording& calibrated) {
  const TestBed& bed = calibrated.bed();
  constexpr double kStep = 0.02;
  const CandidateFit& base = calibrated.base();
  Soil softer = soil_of(bed, calibrated.soil(), base.candidate, base.x);
  softer.kc *= std::exp(-kStep);
  softer.kphi *= std::exp(-kStep);
  const auto changed = predict(bed, softer, std::vector<Mechanism>{});
  if (!changed) return Eigen::MatrixXd(bed.size(), 0);
  const Eigen::VectorXd slope = (*changed - base.prediction) / kStep;
  const Eigen::MatrixXd functions = smooth_functions(bed);
  Eigen::MatrixXd columns(bed.size(), functions.cols());
  for (std::size_t c = 0; c < bed.channels.size(); ++c) {
    const ChannelData& data = bed.channels[c];
    for (std::size_t i = 0; i < data.conditions.size(); ++i) {
      const Eigen::Index row = bed.offset(c) + static_cast<Eigen::Index>(i);
      columns.row(row) = slope[row] * functions.row(static_cast<Eigen::Index>(data.conditions[i]));
    }
  }
  return columns;
}

}  // namespace

Eigen::MatrixXd beforehand(const CandidateFit& base, const Eigen::MatrixXd& residuals) {
  return residuals.colwise() + base.jacobian * base.x;
}

NamelessMisfit::NamelessMisfit(const CalibratedRecording& calibrated,
                               std::vector<std::size_t> settings, const SettingWeights& capped)
    : calibrated_(calibrated),
      settings_(std::move(settings)),
      capped_(capped),
      sinkage_columns_(sinkage_columns(calibrated)) {
  const FitProblem problem = calibrated.problem();
  const WhitenedResiduals recorded(problem.bed, problem.discrepancy,
                                   beforehand(calibrated.base(), calibrated.residual()), capped_);
  Eigen::Index likeliest = 0;
  sinking_nats(recorded).row(0).maxCoeff(&likeliest);
  sinkage_spread_ = kSinkageSpreads[static_cast<std::size_t>(likeliest)];
}

Eigen::MatrixXd NamelessMisfit::sinking_nats(const WhitenedResiduals& residuals) const {
  const FitProblem problem = calibrated_.problem();
  const Eigen::MatrixXd& soil = calibrated_.base().jacobian;
  Eigen::MatrixXd columns(soil.rows(), soil.cols() + sinkage_columns_.cols());
  columns.leftCols(soil.cols()) = soil;
  Eigen::MatrixXd nats(residuals.count(), kSinkageSpreads.size());
  for (std::size_t s = 0; s < kSinkageSpreads.size(); ++s) {
    columns.rightCols(sinkage_columns_.cols()) = kSinkageSpreads.at(s) * sinkage_columns_;
    const std::vector<Evidence> all = evidence_of(problem.bed, problem.discrepancy, residuals,
                                                  columns, problem.soil_free, capped_);
    for (std::size_t r = 0; r < all.size(); ++r) {
      nats(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(s)) = all[r].log_marginal;
    }
  }
  return nats;
}

std::vector<double> NamelessMisfit::log_evidence(const WhitenedResiduals& residuals) const {
  const FitProblem problem = calibrated_.problem();
  const std::vector<Evidence> surfaces =
      evidence_of(problem.bed, problem.discrepancy, residuals, calibrated_.base().jacobian,
                  problem.soil_free, SettingWeights::of_unexplained());
  const Eigen::MatrixXd sinking = sinking_nats(residuals);
  std::vector<double> nats;
  for (std::size_t r = 0; r < surfaces.size(); ++r) {
    const double surface = surfaces[r].log_marginal;
    const auto sinkages = sinking.row(static_cast<Eigen::Index>(r)).array();
    const double top = std::max(surface, sinkages.maxCoeff());
    nats.push_back(top + std::log((std::exp(surface - top) + (sinkages - top).exp().mean()) / 2));
  }
  return nats;
}

Eigen::MatrixXd NamelessMisfit::worlds(std::uint64_t seed) const {
  const TestBed& bed = calibrated_.bed();
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const auto draw = [&](Eigen::Index count) {
    Eigen::VectorXd z(count);
    for (double& value : z) value = normal(random);
    return z;
  };
  std::vector<std::vector<Eigen::LLT<Eigen::MatrixXd>>> covariances;
  for (std::size_t c = 0; c < bed.channels.size(); ++c) {
    covariances.push_back(nameless_covariances(bed, bed.channels[c], settings_[c]));
  }
  const NoiseFactors noise(bed);
  Eigen::MatrixXd worlds = Eigen::MatrixXd::Zero(bed.size(), kWorlds);
  for (std::size_t w = 0; w < kWorlds; ++w) {
    const bool is_sinking = w % 2 == 1;
    auto world = worlds.col(static_cast<Eigen::Index>(w));
    if (is_sinking) world = sinkage_spread_ * sinkage_columns_ * draw(sinkage_columns_.cols());
    for (std::size_t c = 0; c < bed.channels.size(); ++c) {
      const Eigen::Index n = bed.channels[c].mean.size();
      const auto& factor = is_sinking ? noise(c) : covariances[c][w / 2 % covariances[c].size()];
      world.segment(bed.offset(c), n) += factor.matrixL() * draw(n);
    }
  }
  return worlds;
}

}  // namespace regoplan
