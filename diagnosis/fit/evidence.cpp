#include "diagnosis/fit/evidence.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "diagnosis/bed/whitening.h"
#include "terramech/basics/interruption.h"

namespace regoplan {
namespace {

/// Of one channel under one setting's covariance: inner products of the model's columns, which are
/// the jacobian and the discrepancy's covariance with the soil's directions.
struct Products {
  Eigen::MatrixXd inner;
  Eigen::MatrixXd soil_variance;  // of the discrepancy along the soil's directions
  double log_determinant = 0;
  Eigen::MatrixXd with_residuals;  // a column each
  Eigen::VectorXd squared;         // of the residuals themselves
};

Products products(const ChannelCovariance& covariance, const Eigen::MatrixXd& residuals,
                  const Eigen::MatrixXd& jacobian, const Eigen::MatrixXd& soil_free) {
  const Eigen::Index p = jacobian.cols(), q = soil_free.cols();
  Eigen::MatrixXd columns(jacobian.rows(), p + q);
  columns.leftCols(p) = jacobian;
  Products result{.log_determinant = covariance.log_determinant};
  if (covariance.discrepancy.size() == 0) {
    columns.rightCols(q).setZero();
    result.soil_variance.setZero(q, q);
  } else {
    columns.rightCols(q) = covariance.discrepancy * soil_free;
    result.soil_variance = soil_free.transpose() * columns.rightCols(q);
  }
  if (columns.cols() > 0) covariance.factor.matrixL().solveInPlace(columns);
  result.inner = columns.transpose() * columns;
  result.with_residuals = columns.transpose() * residuals;
  result.squared = residuals.colwise().squaredNorm().transpose();
  return result;
}

/// A model's posterior under one setting of every channel.
class JointPosterior {
 public:
  /// \param inner, soil_variance, log_determinant sums of Products over the channels
  JointPosterior(const Eigen::MatrixXd& inner, const Eigen::MatrixXd& soil_variance,
                 double log_determinant)
      : log_determinant_(log_determinant) {
    const Eigen::Index q = soil_variance.rows(), p = inner.rows() - q;
    Eigen::MatrixXd precision = inner.topLeftCorner(p, p);
    precision.diagonal().array() += 1;
    if (q > 0) {
      constexpr double kSoft = 1e-3;  // over the noise's variance along a direction
      Eigen::MatrixXd m = soil_variance;
      m.diagonal().array() += kSoft;
      kept_.compute(m - inner.bottomRightCorner(q, q));
      log_determinant_ += log_determinant_of(kept_) - log_determinant_of(m.llt());
      cross_ = inner.bottomLeftCorner(q, p);
      precision += cross_.transpose() * kept_.solve(cross_);
    }
    precision_.compute(precision);
    log_determinant_ += log_determinant_of(precision_);
  }

  /// \param with_residual, squared sums over the channels of the residual's Products
  double log_marginal(const Eigen::VectorXd& with_residual, double squared, double n) const {
    Eigen::VectorXd b = right_side(with_residual, squared);
    precision_.matrixL().solveInPlace(b);
    return -0.5 *
           (squared - b.squaredNorm() + log_determinant_ + n * std::log(2 * std::numbers::pi));
  }

  Eigen::VectorXd mean(const Eigen::VectorXd& with_residual) const {
    double squared = 0;
    return precision_.solve(right_side(with_residual, squared));
  }
  Eigen::MatrixXd covariance() const {
    return precision_.solve(Eigen::MatrixXd::Identity(precision_.rows(), precision_.rows()));
  }

 private:
  static double log_determinant_of(const Eigen::LLT<Eigen::MatrixXd>& factor) {
    return 2 * factor.matrixLLT().diagonal().array().log().sum();
  }

  /// Of the normal equations; to `squared` comes what the soil's directions take from the
  /// discrepancy.
  Eigen::VectorXd right_side(const Eigen::VectorXd& with_residual, double& squared) const {
    const Eigen::Index p = precision_.rows(), q = with_residual.size() - p;
    Eigen::VectorXd b = with_residual.head(p);
    if (q == 0) return b;
    const Eigen::VectorXd along = kept_.solve(with_residual.tail(q));
    squared += with_residual.tail(q).dot(along);
    b += cross_.transpose() * along;
    return b;
  }

  Eigen::LLT<Eigen::MatrixXd> kept_;  // of the discrepancy's variance off the soil's directions
  Eigen::MatrixXd cross_;
  Eigen::LLT<Eigen::MatrixXd> precision_;
  double log_determinant_;
};

/// One model over all settings of all channels, and its evidence for one residual after the other.
class SettingSearch {
 public:
  SettingSearch(std::vector<std::vector<Products>> parts, const SettingWeights& weights, double n)
      : parts_(std::move(parts)), weights_(weights), n_(n) {}

  /// Per channel in turn the likeliest setting, the others held.
  Evidence evidence_of(Eigen::Index residual) {
    Evidence evidence;
    std::vector<std::size_t>& held = evidence.settings;
    held.assign(parts_.size(), 0);
    double best = log_weighed(held, residual);
    double spread = 0;
    for (int sweep = 0; sweep < 6; ++sweep) {
      bool changed = false;
      spread = 0;
      for (std::size_t c = 0; c < parts_.size(); ++c) {
        const std::vector<double> scores = along(c, held, residual, best, changed);
        double share = 0;
        for (const double score : scores) share += std::exp(score - best);
        spread += std::log(share);
      }
      if (!changed) break;
    }
    const JointPosterior& posterior = under(held);
    evidence.log_marginal = best + spread;
    evidence.x = posterior.mean(with(held, residual));
    evidence.covariance = posterior.covariance();
    return evidence;
  }

 private:
  /// Of every setting of a channel; the best is held on.
  std::vector<double> along(std::size_t channel, std::vector<std::size_t>& held,
                            Eigen::Index residual, double& best, bool& changed) {
    std::vector<double> scores;
    std::vector<std::size_t> trial = held;
    for (std::size_t k = 0; k < weights_.log_weight.size(); ++k) {
      if (weights_.excludes(channel, k)) continue;
      trial[channel] = k;
      const double score = log_weighed(trial, residual);
      scores.push_back(score);
      if (score > best + 1e-9) {
        best = score;
        changed = changed || held[channel] != k;
        held[channel] = k;
      }
    }
    return scores;
  }

  double log_weighed(const std::vector<std::size_t>& settings, Eigen::Index residual) {
    double squared = 0, log_weight = 0;
    for (std::size_t c = 0; c < parts_.size(); ++c) {
      squared += parts_[c][settings[c]].squared[residual];
      log_weight += weights_.log_weight[settings[c]];
    }
    return under(settings).log_marginal(with(settings, residual), squared, n_) + log_weight;
  }

  Eigen::VectorXd with(const std::vector<std::size_t>& settings, Eigen::Index residual) const {
    Eigen::VectorXd sum = parts_[0][settings[0]].with_residuals.col(residual);
    for (std::size_t c = 1; c < parts_.size(); ++c) {
      sum += parts_[c][settings[c]].with_residuals.col(residual);
    }
    return sum;
  }

  const JointPosterior& under(const std::vector<std::size_t>& settings) {
    const auto known = posteriors_.find(settings);
    if (known != posteriors_.end()) return known->second;
    Eigen::MatrixXd inner = parts_[0][settings[0]].inner;
    Eigen::MatrixXd soil_variance = parts_[0][settings[0]].soil_variance;
    double log_determinant = parts_[0][settings[0]].log_determinant;
    for (std::size_t c = 1; c < parts_.size(); ++c) {
      const Products& part = parts_[c][settings[c]];
      inner += part.inner;
      soil_variance += part.soil_variance;
      log_determinant += part.log_determinant;
    }
    return posteriors_.try_emplace(settings, inner, soil_variance, log_determinant).first->second;
  }

  std::vector<std::vector<Products>> parts_;  // by channel and setting
  const SettingWeights& weights_;
  double n_;
  std::map<std::vector<std::size_t>, JointPosterior> posteriors_;
};

}  // namespace

Eigen::MatrixXd soil_directions(const TestBed& bed, const Eigen::MatrixXd& soil_jacobian) {
  if (soil_jacobian.cols() == 0) return Eigen::MatrixXd(bed.size(), 0);
  const NoiseFactors factor(bed);
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(whitened(bed, factor, soil_jacobian),
                                              Eigen::ComputeThinU);
  constexpr double kStrong = 3;  // standard deviations of the noise per prior standard deviation
  Eigen::Index strong = 0;
  while (strong < svd.singularValues().size() && svd.singularValues()[strong] > kStrong) ++strong;
  Eigen::MatrixXd directions = svd.matrixU().leftCols(strong);
  for (std::size_t c = 0; c < bed.channels.size(); ++c) {
    auto block = directions.middleRows(bed.offset(c), bed.channels[c].mean.size());
    block = factor(c).matrixU().solve(block);
  }
  return directions;
}

Posterior posterior_of(const TestBed& bed, const Discrepancy& discrepancy, const Linearised& linear,
                       const std::vector<std::size_t>& settings) {
  const Eigen::Index p = linear.jacobian.cols();
  const auto factor = factors_under(discrepancy, settings);
  const Eigen::MatrixXd j = whitened(bed, factor, linear.jacobian);
  const Eigen::VectorXd r = whitened(bed, factor, linear.residual);
  Posterior posterior{.precision = j.transpose() * j + Eigen::MatrixXd::Identity(p, p)};
  posterior.x = Eigen::LLT<Eigen::MatrixXd>(posterior.precision).solve(j.transpose() * r);
  return posterior;
}

double misfit_of(const TestBed& bed, const Discrepancy& discrepancy,
                 const Eigen::VectorXd& residual, const std::vector<std::size_t>& settings) {
  return whitened(bed, factors_under(discrepancy, settings), residual).squaredNorm();
}

Eigen::MatrixXd smooth_functions(const TestBed& bed) {
  constexpr std::size_t kMiddling = 1;
  constexpr Eigen::Index kMost = 8;
  throw_if_stopped(bed.stop);
  ConditionsAt everywhere;
  for (const Condition& condition : bed.conditions) everywhere.push_back(&condition);
  const Eigen::MatrixXd kernel =
      discrepancy_kernels(discrepancy_scales()[kMiddling], Channel::kFx, everywhere, everywhere);
  const Eigen::Index n = kernel.rows();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(kernel);
  const Eigen::Index count = std::min(kMost, n);
  return modes.eigenvectors().rightCols(count) *
         modes.eigenvalues().tail(count).cwiseMax(0).cwiseSqrt().asDiagonal();
}

Evidence evidence_of(const TestBed& bed, const Discrepancy& discrepancy, const Linearised& linear,
                     const Eigen::MatrixXd& soil_free, const SettingWeights& weights) {
  const WhitenedResiduals residual(bed, discrepancy, linear.residual, weights);
  return evidence_of(bed, discrepancy, residual, linear.jacobian, soil_free, weights).front();
}

WhitenedResiduals::WhitenedResiduals(const TestBed& bed, const Discrepancy& discrepancy,
                                     const Eigen::MatrixXd& residuals,
                                     const SettingWeights& weights)
    : at_(bed.channels.size()), count_(static_cast<std::size_t>(residuals.cols())) {
  for (std::size_t c = 0; c < at_.size(); ++c) {
    for (std::size_t k = 0; k < weights.log_weight.size(); ++k) {
      throw_if_stopped(bed.stop);
      Eigen::MatrixXd& own = at_[c].emplace_back();
      if (weights.excludes(c, k)) continue;
      own = residuals.middleRows(bed.offset(c), bed.channels[c].mean.size());
      discrepancy.at(c, k).factor.matrixL().solveInPlace(own);
    }
  }
}

std::vector<Evidence> evidence_of(const TestBed& bed, const Discrepancy& discrepancy,
                                  const WhitenedResiduals& residuals,
                                  const Eigen::MatrixXd& jacobian, const Eigen::MatrixXd& soil_free,
                                  const SettingWeights& weights) {
  std::vector<std::vector<Products>> parts(bed.channels.size());
  for (std::size_t c = 0; c < parts.size(); ++c) {
    const Eigen::Index from = bed.offset(c), n = bed.channels[c].mean.size();
    for (std::size_t k = 0; k < weights.log_weight.size(); ++k) {
      throw_if_stopped(bed.stop);
      Products& part = parts[c].emplace_back();
      if (weights.excludes(c, k)) continue;
      part = products(discrepancy.at(c, k), residuals.at(c, k), jacobian.middleRows(from, n),
                      soil_free.middleRows(from, n));
    }
  }
  SettingSearch search(std::move(parts), weights, static_cast<double>(bed.size()));
  std::vector<Evidence> all;
  for (std::size_t r = 0; r < residuals.count(); ++r) {
    throw_if_stopped(bed.stop);
    all.push_back(search.evidence_of(static_cast<Eigen::Index>(r)));
  }
  return all;
}

}  // namespace regoplan
