#include "diagnosis/fit/evidence.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "diagnosis/bed/whitening.h"
#include "terramech/basics/interruption.h"

namespace regoplan {
namespace {

/// \param of_amplitude weights of kDiscrepancyAmplitudes
SettingWeights weights_of(const std::array<double, kDiscrepancyAmplitudes.size()>& of_amplitude) {
  const double scales = static_cast<double>(discrepancy_scales().size());
  double sum = 0;
  for (const double w : of_amplitude) sum += w;
  SettingWeights weights;
  for (const DiscrepancySetting& setting : discrepancy_settings()) {
    const auto amplitude = std::ranges::find(kDiscrepancyAmplitudes, setting.amplitude) -
                           kDiscrepancyAmplitudes.begin();
    const double w = of_amplitude.at(static_cast<std::size_t>(amplitude)) / sum /
                     (setting.amplitude > 0 ? scales : 1);
    const double sides = setting.sides == Sides::kApart ? kApart_log_prior : 0;
    weights.log_weight.push_back(w > 0 ? std::log(w) + sides : -1e300);
  }
  return weights;
}

/// Inner products of the columns [residual, jacobian, B] under one setting's covariance, B being
/// the discrepancy's covariance with the soil's directions.
struct Products {
  Eigen::MatrixXd inner;
  Eigen::MatrixXd soil_variance;  // of the discrepancy along the soil's directions
  double log_determinant = 0;
};

Products products(const ChannelCovariance& covariance, const Eigen::VectorXd& residual,
                  const Eigen::MatrixXd& jacobian, const Eigen::MatrixXd& soil_free) {
  const Eigen::Index p = jacobian.cols(), q = soil_free.cols();
  Eigen::MatrixXd columns(residual.size(), 1 + p + q);
  columns.col(0) = residual;
  columns.middleCols(1, p) = jacobian;
  Products result{.log_determinant = covariance.log_determinant};
  if (covariance.discrepancy.size() == 0) {
    columns.rightCols(q).setZero();
    result.soil_variance.setZero(q, q);
  } else {
    columns.rightCols(q) = covariance.discrepancy * soil_free;
    result.soil_variance = soil_free.transpose() * columns.rightCols(q);
  }
  covariance.factor.matrixL().solveInPlace(columns);
  result.inner = columns.transpose() * columns;
  return result;
}

struct Value {
  double log_marginal = 0;
  Eigen::VectorXd x;
  Eigen::MatrixXd precision;
};

/// Evidence for sums of products over the channels.
Value value_of(const Products& sum, Eigen::Index p, double n) {
  const Eigen::Index q = sum.soil_variance.rows();
  Eigen::MatrixXd inner = sum.inner.topLeftCorner(1 + p, 1 + p);
  double log_determinant = sum.log_determinant;
  if (q > 0) {
    constexpr double kSoft = 1e-3;  // over the noise's variance along a direction
    Eigen::MatrixXd m = sum.soil_variance;
    m.diagonal().array() += kSoft;
    Eigen::MatrixXd s = m - sum.inner.bottomRightCorner(q, q);
    const Eigen::LLT<Eigen::MatrixXd> factor(s), prior(m);
    log_determinant += 2 * factor.matrixLLT().diagonal().array().log().sum() -
                       2 * prior.matrixLLT().diagonal().array().log().sum();
    const Eigen::MatrixXd cross = sum.inner.bottomLeftCorner(q, 1 + p);
    inner += cross.transpose() * factor.solve(cross);
  }
  Value value;
  value.precision = inner.bottomRightCorner(p, p);
  value.precision.diagonal().array() += 1;
  const Eigen::LLT<Eigen::MatrixXd> factor(value.precision);
  const Eigen::VectorXd b = inner.bottomLeftCorner(p, 1);
  value.x = factor.solve(b);
  const double quadratic = inner(0, 0) - b.dot(value.x);
  const double precision = 2 * factor.matrixLLT().diagonal().array().log().sum();
  value.log_marginal =
      -0.5 * (quadratic + log_determinant + precision + n * std::log(2 * std::numbers::pi));
  return value;
}

void add(Products& to, const Products& part, double sign) {
  to.inner += sign * part.inner;
  to.soil_variance += sign * part.soil_variance;
  to.log_determinant += sign * part.log_determinant;
}

}  // namespace

SettingWeights SettingWeights::of_named() {
  return weights_of({.4, .3, .2, .07, .02, .006, .003, .001});
}
SettingWeights SettingWeights::of_none() {
  return weights_of({.5, .3, .2, 0, 0, 0, 0, 0});
}
SettingWeights SettingWeights::of_unexplained() {
  return weights_of({.1, .1, .13, .13, .13, .13, .13, .13});
}

SettingWeights SettingWeights::up_to(std::vector<double> most_amplitude) {
  SettingWeights weights = weights_of({1, 1, 1, 1, 1, 1, 1, 1});
  weights.most_amplitude = std::move(most_amplitude);
  return weights;
}

bool SettingWeights::excludes(std::size_t channel, std::size_t setting) const {
  if (log_weight[setting] < -1e200) return true;
  return !most_amplitude.empty() &&
         discrepancy_settings()[setting].amplitude > most_amplitude[channel];
}

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
  const Eigen::Index p = linear.jacobian.cols();
  const std::size_t settings = weights.log_weight.size();
  std::vector<std::vector<Products>> parts(bed.channels.size());
  for (std::size_t c = 0; c < bed.channels.size(); ++c) {
    const Eigen::Index from = bed.offset(c), n = bed.channels[c].mean.size();
    for (std::size_t k = 0; k < settings; ++k) {
      throw_if_stopped(bed.stop);
      if (weights.excludes(c, k)) {
        parts[c].emplace_back();
        continue;
      }
      parts[c].push_back(products(discrepancy.at(c, k), linear.residual.segment(from, n),
                                  linear.jacobian.middleRows(from, n),
                                  soil_free.middleRows(from, n)));
    }
  }
  // per channel in turn the likeliest setting, the others held
  Evidence evidence;
  evidence.settings.assign(bed.channels.size(), 0);
  Products sum = parts[0][0];
  for (std::size_t c = 1; c < parts.size(); ++c) add(sum, parts[c][0], 1);
  const auto n = static_cast<double>(bed.size());
  double prior = static_cast<double>(parts.size()) * weights.log_weight[0];
  double best = value_of(sum, p, n).log_marginal + prior;
  double spread = 0;
  for (int sweep = 0; sweep < 6; ++sweep) {
    throw_if_stopped(bed.stop);
    bool changed = false;
    spread = 0;
    for (std::size_t c = 0; c < parts.size(); ++c) {
      const std::size_t held = evidence.settings[c];
      std::size_t chosen = held;
      std::vector<double> scores;
      const double others = prior - weights.log_weight[held];
      add(sum, parts[c][held], -1);
      for (std::size_t k = 0; k < settings; ++k) {
        if (weights.excludes(c, k)) continue;
        Products trial = sum;
        add(trial, parts[c][k], 1);
        const double score = value_of(trial, p, n).log_marginal + others + weights.log_weight[k];
        scores.push_back(score);
        if (score > best + 1e-9) {
          best = score;
          chosen = k;
        }
      }
      add(sum, parts[c][chosen], 1);
      prior = others + weights.log_weight[chosen];
      evidence.settings[c] = chosen;
      changed = changed || chosen != held;
      double share = 0;
      for (const double score : scores) share += std::exp(score - best);
      spread += std::log(share);
    }
    if (!changed) break;
  }
  const Value value = value_of(sum, p, n);
  evidence.log_marginal = best + spread;
  evidence.x = value.x;
  evidence.covariance =
      Eigen::LLT<Eigen::MatrixXd>(value.precision).solve(Eigen::MatrixXd::Identity(p, p));
  return evidence;
}

}  // namespace regoplan
