#include "diagnosis/checks/detection.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <random>

#include "diagnosis/bed/whitening.h"
#include "terramech/basics/interruption.h"

namespace regoplan {
namespace {

/// The mean of runs with heavy tails: Student's t of as many degrees of freedom as have the
/// kurtosis of that mean, scaled to the standard deviation 1.
double mean_of_heavy_tailed(std::size_t runs, double normal, std::mt19937_64& random) {
  const double dof = 4 + static_cast<double>(runs);
  std::chi_squared_distribution<double> chi2(dof);
  return normal * std::sqrt((dof - 2) / chi2(random));
}

/// Noise factors per channel and the fit's response, whitened.
class WhitenedFit {
 public:
  WhitenedFit(const CondensedRecording& recording, const FitRemainder& fit,
              NoiseTails tails = NoiseTails::kNormal)
      : recording_(recording),
        fit_(fit),
        tails_(tails),
        factor_(recording.bed),
        jacobian_(whitened(recording.bed, factor_, fit.jacobian)),
        uncertain_(whitened(recording.bed, factor_, fit.uncertain)) {
    const Eigen::Index p = jacobian_.cols();
    precision_ = (jacobian_.transpose() * jacobian_ + Eigen::MatrixXd::Identity(p, p)).eval().llt();
    Eigen::MatrixXd correlation = recording.correlation;
    correlation.diagonal().array() += 1e-6;
    mix_ = correlation.llt().matrixL();
  }

  Eigen::VectorXd whiten(const Eigen::VectorXd& values) const {
    return whitened(recording_.bed, factor_, values);
  }

  /// Values less what the fit takes up of them.
  Eigen::MatrixXd left_by_fit(const Eigen::MatrixXd& whitened) const {
    return whitened - jacobian_ * precision_.solve(jacobian_.transpose() * whitened);
  }

  Eigen::VectorXd colour(Eigen::VectorXd values) const {
    const TestBed& bed = recording_.bed;
    for (std::size_t c = 0; c < bed.channels.size(); ++c) {
      auto block = values.segment(bed.offset(c), bed.channels[c].mean.size());
      block = factor_(c).matrixL() * block.eval();
    }
    return values;
  }

  struct Draw {
    Eigen::VectorXd residual;  // whitened, after the fit
    Eigen::VectorXd x;
  };

  Draw draw(std::mt19937_64& random) const {
    const TestBed& bed = recording_.bed;
    throw_if_stopped(bed.stop);
    std::normal_distribution<double> normal;
    const auto channels = static_cast<Eigen::Index>(bed.channels.size());
    Eigen::MatrixXd together(channels, static_cast<Eigen::Index>(bed.conditions.size()));
    for (double& value : together.reshaped()) value = normal(random);
    together = (mix_ * together).eval();
    Eigen::VectorXd z(bed.size());
    for (Eigen::Index c = 0; c < channels; ++c) {
      const auto i = static_cast<std::size_t>(c);
      double scale = 1;
      const ChannelNoise& noise = recording_.noise[i];
      if (const int dof = noise.degrees_of_freedom + noise.neighbour_degrees_of_freedom; dof > 0) {
        std::chi_squared_distribution<double> chi2(dof);
        scale = std::sqrt(dof / std::max(chi2(random), 0.05 * dof));
      }
      Eigen::Index row = bed.offset(i);
      for (const std::size_t k : bed.channels[i].conditions) {
        double value = together(c, static_cast<Eigen::Index>(k));
        if (tails_ == NoiseTails::kHeavy) {
          value = mean_of_heavy_tailed(bed.conditions[k].runs.size(), value, random);
        }
        z[row++] = scale * value;
      }
    }
    Eigen::VectorXd truth(jacobian_.cols());
    for (double& value : truth) value = fit_.truth_spread * normal(random);
    z += jacobian_ * truth;
    const Eigen::VectorXd x = precision_.solve(jacobian_.transpose() * z);
    Eigen::VectorXd residual = z - jacobian_ * x;
    for (const auto& column : uncertain_.colwise()) residual += normal(random) * column;
    return {residual, x};
  }

  /// Misfit of all channels with the priors, then of each channel.
  Eigen::VectorXd statistics(const Eigen::VectorXd& whitened, const Eigen::VectorXd& x) const {
    const TestBed& bed = recording_.bed;
    Eigen::VectorXd all(static_cast<Eigen::Index>(bed.channels.size()) + 1);
    all[0] = whitened.squaredNorm() + x.squaredNorm();
    for (std::size_t c = 0; c < bed.channels.size(); ++c) {
      all[static_cast<Eigen::Index>(c) + 1] =
          whitened.segment(bed.offset(c), bed.channels[c].mean.size()).squaredNorm();
    }
    return all;
  }

 private:
  const CondensedRecording& recording_;
  const FitRemainder& fit_;
  NoiseTails tails_;
  NoiseFactors factor_;
  Eigen::MatrixXd jacobian_, uncertain_;
  Eigen::LLT<Eigen::MatrixXd> precision_;
  Eigen::MatrixXd mix_;
};

}  // namespace

NoiseTails tails_of(const CondensedRecording& recording) {
  const bool replicated = std::ranges::any_of(
      recording.noise, [](const ChannelNoise& noise) { return noise.degrees_of_freedom > 0; });
  return replicated ? NoiseTails::kNormal : NoiseTails::kHeavy;
}

LackOfFit lack_of_fit(const CondensedRecording& recording, const FitRemainder& fit,
                      std::uint64_t seed, double significance, NoiseTails tails, int draw_count) {
  const WhitenedFit whitened(recording, fit, tails);
  const Eigen::VectorXd found = whitened.statistics(whitened.whiten(fit.residual), fit.x);
  std::mt19937_64 random(seed);
  Eigen::MatrixXd draws(found.size(), draw_count);
  for (int i = 0; i < draw_count; ++i) {
    const auto draw = whitened.draw(random);
    draws.col(i) = whitened.statistics(draw.residual, draw.x);
  }
  // the worst of all statistics, each on a scale of its own (logarithms are nearly normal)
  const Eigen::MatrixXd logs = draws.array().log();
  const Eigen::VectorXd mean = logs.rowwise().mean();
  const Eigen::VectorXd deviation =
      ((logs.colwise() - mean).array().square().rowwise().mean()).sqrt();
  const Eigen::VectorXd scores =
      ((found.array().log() - mean.array()) / deviation.array()).matrix();
  std::vector<double> worst(static_cast<std::size_t>(draw_count));
  for (int i = 0; i < draw_count; ++i) {
    worst[static_cast<std::size_t>(i)] =
        ((logs.col(i) - mean).array() / deviation.array()).maxCoeff();
  }
  std::ranges::sort(worst);
  const auto rank = static_cast<std::size_t>(std::ceil((1 - significance) * draw_count)) - 1;
  Eigen::Index at = 0;
  const double score = scores.maxCoeff(&at);
  const auto beyond = worst.end() - std::ranges::lower_bound(worst, score);
  const double expected = std::exp(mean[at]);
  LackOfFit result;
  result.f = found[at] / expected;
  result.critical = std::exp(worst[rank] * deviation[at]);
  result.p_value = (1.0 + static_cast<double>(beyond)) / (draw_count + 1.0);
  result.degrees_of_freedom = static_cast<int>(
      at == 0 ? recording.bed.size()
              : recording.bed.channels[static_cast<std::size_t>(at - 1)].mean.size());
  for (std::size_t c = 0; c < recording.noise.size(); ++c) {
    if (at == 0 || static_cast<std::size_t>(at - 1) == c) {
      result.pure_error_degrees_of_freedom += recording.noise[c].degrees_of_freedom;
    }
  }
  return result;
}

double p_value_along(const CondensedRecording& recording, const FitRemainder& fit,
                     const std::vector<Direction>& directions, std::uint64_t seed, NoiseTails tails,
                     int draw_count) {
  const WhitenedFit whitened(recording, fit, tails);
  const auto count = static_cast<Eigen::Index>(directions.size());
  if (count == 0) return 1;
  Eigen::MatrixXd along(recording.bed.size(), count);
  for (Eigen::Index i = 0; i < count; ++i) {
    along.col(i) = whitened.whiten(directions[static_cast<std::size_t>(i)].values);
  }
  along = whitened.left_by_fit(along);
  std::mt19937_64 random(seed);
  Eigen::MatrixXd draws(count, draw_count);
  for (int i = 0; i < draw_count; ++i)
    draws.col(i) = along.transpose() * whitened.draw(random).residual;
  const Eigen::VectorXd deviation =
      draws.array().square().rowwise().mean().sqrt().max(1e-300).matrix();
  const auto farthest = [&](const Eigen::VectorXd& values) {
    double most = 0;
    for (Eigen::Index i = 0; i < count; ++i) {
      const double z = values[i] / deviation[i];
      most = std::max(most, directions[static_cast<std::size_t>(i)].either_sign ? std::abs(z) : z);
    }
    return most;
  };
  const double found = farthest(along.transpose() * whitened.whiten(fit.residual));
  int beyond = 0;
  for (int i = 0; i < draw_count; ++i) beyond += farthest(draws.col(i)) >= found;
  return (1.0 + beyond) / (draw_count + 1.0);
}

Eigen::MatrixXd residuals_of_noise(const CondensedRecording& recording, const FitRemainder& fit,
                                   std::uint64_t seed, int draws) {
  const WhitenedFit whitened(recording, fit);
  std::mt19937_64 random(seed);
  Eigen::MatrixXd residuals(recording.bed.size(), draws);
  for (int i = 0; i < draws; ++i) {
    residuals.col(i) = whitened.colour(whitened.draw(random).residual);
  }
  return residuals;
}

}  // namespace regoplan
