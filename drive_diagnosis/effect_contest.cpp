#include "drive_diagnosis/effect_contest.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>

#include "drive_diagnosis/robust_statistics.h"

namespace regoplan {
namespace {

constexpr double kMissed = 1e-3;  ///< chance of a false claim in a whole contest
constexpr double kAlike = 10;     ///< twice 5 nats

/// Effects as unit vectors in the metric of the data, with the length they had.
struct Directions {
  Eigen::MatrixXd unit;
  Eigen::VectorXd length;
};

/// Makes the data white once more: what the priors let vary is taken as noise.
class Metric {
 public:
  Metric(Eigen::Index n, const std::vector<EffectColumn>& effects,
         const std::vector<std::size_t>& freed) {
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(n, n);
    for (const EffectColumn& effect : effects) {
      if (effect.prior_std > 0) {
        covariance +=
            effect.prior_std * effect.prior_std * effect.column * effect.column.transpose();
      }
    }
    for (const std::size_t i : freed) {
      const Eigen::VectorXd& column = effects[i].column;
      covariance +=
          1e4 / column.squaredNorm() * column * column.transpose() * static_cast<double>(n);
    }
    factor_.compute(covariance);
  }
  Eigen::VectorXd whitened(const Eigen::VectorXd& data) const {
    return factor_.matrixL().solve(data);
  }
  Directions directions(const std::vector<EffectColumn>& effects) const {
    Directions result{Eigen::MatrixXd(factor_.rows(), static_cast<Eigen::Index>(effects.size())),
                      Eigen::VectorXd(static_cast<Eigen::Index>(effects.size()))};
    for (std::size_t i = 0; i < effects.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      result.unit.col(k) = factor_.matrixL().solve(effects[i].column);
      result.length[k] = result.unit.col(k).norm();
      if (result.length[k] > 0) result.unit.col(k) /= result.length[k];
    }
    return result;
  }

 private:
  Eigen::LLT<Eigen::MatrixXd> factor_;
};

/// The largest of all effects in each null draw, sorted.
std::vector<double> null_maxima(const Directions& directions, std::uint64_t seed) {
  constexpr int kDraws = 1000;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<double> maxima;
  Eigen::VectorXd draw(directions.unit.rows());
  for (int i = 0; i < kDraws; ++i) {
    for (double& value : draw) value = normal(random);
    maxima.push_back((directions.unit.transpose() * draw).cwiseAbs().maxCoeff());
  }
  std::ranges::sort(maxima);
  return maxima;
}

}  // namespace

std::vector<EffectFound> find_effects(const Eigen::VectorXd& data,
                                      const std::vector<EffectColumn>& effects, int effects_max,
                                      std::uint64_t seed) {
  std::vector<EffectFound> found;
  std::vector<std::size_t> freed;
  while (static_cast<int>(found.size()) < effects_max) {
    const Metric metric(data.size(), effects, freed);
    const Eigen::VectorXd white = metric.whitened(data);
    const Directions directions = metric.directions(effects);
    const Eigen::VectorXd z = directions.unit.transpose() * white;
    Eigen::Index best = 0;
    z.cwiseAbs().maxCoeff(&best);
    const Eigen::VectorXd left = white - z[best] * directions.unit.col(best);
    const double wide =
        std::max(1.0, std::sqrt(left.squaredNorm() / static_cast<double>(data.size())));
    const std::vector<double> maxima = null_maxima(directions, seed);
    const double sigmas = std::abs(z[best]) / wide;
    const double threshold = kToSpare * quantile_value(maxima, 1 - kMissed);
    if (!(sigmas > threshold)) break;
    const auto above = static_cast<double>(maxima.end() - std::ranges::lower_bound(maxima, sigmas));
    EffectFound effect{
        .effect = static_cast<std::size_t>(best),
        .size = z[best] / directions.length[best] * effects[static_cast<std::size_t>(best)].unit,
        .std = wide / directions.length[best] * effects[static_cast<std::size_t>(best)].unit,
        .sigmas = sigmas,
        .p_value = (above + 1) / static_cast<double>(maxima.size() + 1),
        .alike = {static_cast<std::size_t>(best)}};
    for (std::size_t i = 0; i < effects.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      if (k != best && z[k] * z[k] > z[best] * z[best] - kAlike * wide * wide) {
        effect.alike.push_back(i);
      }
    }
    freed.push_back(effect.effect);
    found.push_back(std::move(effect));
  }
  return found;
}

}  // namespace regoplan
