#include "drive_diagnosis/residual_noise.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "drive_diagnosis/robust_statistics.h"

namespace regoplan {
namespace {

constexpr double kMad = 0.6745;     ///< median of |x| of a normal x
constexpr double kFar = 2.5;        ///< beyond, a residual counts less
constexpr double kOfNormal = 0.92;  ///< mean of min(x^2, kFar^2) of a normal x

}  // namespace

ResidualNoise::ResidualNoise(ResidualParts parts) : parts_(std::move(parts)) {
  const Eigen::MatrixXd& residuals = parts_.residuals;
  share_.assign(static_cast<std::size_t>(residuals.cols()), 0);
  for (Eigen::Index k = 0; k < residuals.cols(); ++k) {
    std::vector<double> steps;
    for (Eigen::Index i = 1; i < residuals.rows(); ++i) {
      if (!parts_.follows[static_cast<std::size_t>(i)]) continue;
      steps.push_back(std::abs(residuals(i, k) - residuals(i - 1, k)));
    }
    constexpr double kLeast = 1e-9;
    scale_.push_back(steps.empty() ? 1
                                   : std::max(kLeast, median_value(steps) / kMad / std::sqrt(2)));
  }
  const auto windows = static_cast<double>(residuals.rows());
  const double freedom = std::max(0.3, 1 - static_cast<double>(parts_.columns.size()) /
                                               (windows * static_cast<double>(residuals.cols())));
  input_scale_.assign(parts_.inputs.size(), 1);
  constexpr int kRounds = 15;
  Eigen::MatrixXd left = residuals;
  for (int round = 0; round < kRounds; ++round) {
    factor();
    left = fitted_residuals();
    if (round == 0) choose_shares(left);
    update(left, freedom);
    update_inputs(left, freedom);
  }
  widen_what_goes_on(left);
  factor();
}

Eigen::VectorXd ResidualNoise::variances(Eigen::Index window) const {
  Eigen::VectorXd result(parts_.residuals.cols());
  for (Eigen::Index k = 0; k < result.size(); ++k) {
    const auto channel = static_cast<std::size_t>(k);
    const double scale =
        scale_[channel] * std::hypot(1, share_[channel] * parts_.reference(window, k));
    result[k] = scale * scale;
  }
  return result;
}

void ResidualNoise::factor() {
  root_.clear();
  known_root_.clear();
  covariance_.clear();
  const Eigen::Index channels = parts_.residuals.cols();
  for (Eigen::Index w = 0; w < parts_.residuals.rows(); ++w) {
    Eigen::MatrixXd known = variances(w).asDiagonal(), estimated = 0 * known;
    for (std::size_t k = 0; k < parts_.inputs.size(); ++k) {
      const Eigen::VectorXd column = input_scale_[k] * parts_.inputs[k].row(w).transpose();
      (parts_.scatters_unknown[k] ? estimated : known) += column * column.transpose();
    }
    const auto root_of = [channels](const Eigen::MatrixXd& covariance) -> Eigen::MatrixXd {
      return covariance.llt().matrixL().solve(Eigen::MatrixXd::Identity(channels, channels));
    };
    known_root_.push_back(root_of(known));
    root_.push_back(root_of(known + estimated));
    covariance_.emplace_back(known + estimated);
  }
}

Eigen::VectorXd ResidualNoise::whitened(const Eigen::MatrixXd& by_window) const {
  return whitened(by_window, known_root_);
}

Eigen::VectorXd ResidualNoise::whitened(const Eigen::MatrixXd& by_window,
                                        const std::vector<Eigen::MatrixXd>& roots) {
  Eigen::VectorXd white(by_window.size());
  const Eigen::Index channels = by_window.cols();
  for (Eigen::Index w = 0; w < by_window.rows(); ++w) {
    white.segment(w * channels, channels) =
        roots[static_cast<std::size_t>(w)] * by_window.row(w).transpose();
  }
  return white;
}

double ResidualNoise::nats(const Eigen::MatrixXd& residuals) const {
  double sum = 0;
  for (const double z : whitened(residuals, root_)) {
    const double size = std::abs(z);
    sum += size < kFar ? size * size / 2 : kFar * (size - kFar / 2);
  }
  for (const Eigen::MatrixXd& root : root_) sum -= root.diagonal().array().log().sum();
  return sum;
}

Eigen::MatrixXd ResidualNoise::inputs_given(const Eigen::MatrixXd& residuals) const {
  Eigen::MatrixXd result(residuals.rows(), static_cast<Eigen::Index>(parts_.inputs.size()));
  for (Eigen::Index w = 0; w < residuals.rows(); ++w) {
    const Eigen::MatrixXd& root = root_[static_cast<std::size_t>(w)];
    const Eigen::VectorXd white = root * residuals.row(w).transpose();
    for (std::size_t k = 0; k < parts_.inputs.size(); ++k) {
      const Eigen::VectorXd column = root * parts_.inputs[k].row(w).transpose();
      const double variance = input_scale_[k] * input_scale_[k];
      result(w, static_cast<Eigen::Index>(k)) = variance * column.dot(white);
    }
  }
  return result;
}

/// What is left of residuals when the parameters, wider than those of a sound vehicle, are fitted;
/// far residuals count less.
Eigen::MatrixXd ResidualNoise::fitted_residuals() const {
  const auto count = static_cast<Eigen::Index>(parts_.columns.size());
  const auto wider = [this](Eigen::Index c) {
    constexpr double kWider = 10;  // a fault of the vehicle is no noise
    return parts_.may_be_wrong[static_cast<std::size_t>(c)] ? kWider : 1.0;
  };
  Eigen::MatrixXd design(parts_.residuals.size(), count);
  for (Eigen::Index c = 0; c < count; ++c) {
    design.col(c) = wider(c) * whitened(parts_.columns[static_cast<std::size_t>(c)], root_);
  }
  const Eigen::VectorXd data = whitened(parts_.residuals, root_);
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(data.size()), x = Eigen::VectorXd::Zero(count);
  constexpr int kRounds = 4;
  for (int round = 0; round < kRounds; ++round) {
    const Eigen::MatrixXd weighted = weights.asDiagonal() * design;
    const Eigen::LLT<Eigen::MatrixXd> normal(design.transpose() * weighted +
                                             Eigen::MatrixXd::Identity(count, count));
    x = normal.solve(weighted.transpose() * data);
    const Eigen::VectorXd off = data - design * x;
    for (Eigen::Index i = 0; i < off.size(); ++i) {
      weights[i] = std::min(1.0, kFar / std::max(1e-12, std::abs(off[i])));
    }
  }
  Eigen::MatrixXd left = parts_.residuals;
  for (Eigen::Index c = 0; c < count; ++c) {
    left -= wider(c) * x[c] * parts_.columns[static_cast<std::size_t>(c)];
  }
  return left;
}

/// A channel's own variance: by how much more the residuals scatter, seen through all channels,
/// than they would with it as it is.
void ResidualNoise::update(const Eigen::MatrixXd& left, double freedom) {
  Eigen::VectorXd seen = Eigen::VectorXd::Zero(left.cols()), due = seen;
  for (Eigen::Index w = 0; w < left.rows(); ++w) {
    const Eigen::MatrixXd& root = root_[static_cast<std::size_t>(w)];
    const Eigen::MatrixXd inverse = root.transpose() * root;
    const Eigen::VectorXd solved = inverse * left.row(w).transpose();
    const Eigen::VectorXd own = variances(w);
    for (Eigen::Index k = 0; k < left.cols(); ++k) {
      const double known = inverse(k, k);
      seen[k] += own[k] * std::min(solved[k] * solved[k], kFar * kFar * known) / kOfNormal;
      due[k] += own[k] * known;
    }
  }
  // Wheels' torques are measured alike: one ratio for all, as the inputs' scatter would else hide
  // in any one of them.
  double seen_alike = 0, due_alike = 0;
  for (Eigen::Index k = 0; k < left.cols(); ++k) {
    if (!is_alike(k)) continue;
    seen_alike += seen[k];
    due_alike += due[k];
  }
  // Where the inputs' scatter hides theirs, neighbouring samples say what it is: worth so many
  // windows of one wheel.
  constexpr double kSamplesWorth = 30;
  const double sampled = sampled_scale();
  for (Eigen::Index k = 0; k < left.cols(); ++k) {
    if (!is_alike(k) || !(sampled > 0)) continue;
    const double ratio = sampled / scale_[static_cast<std::size_t>(k)];
    seen_alike += kSamplesWorth * ratio * ratio;
    due_alike += kSamplesWorth;
    break;  // alike channels have one scale
  }
  for (Eigen::Index k = 0; k < left.cols(); ++k) {
    if (is_alike(k)) {
      seen[k] = seen_alike;
      due[k] = due_alike;
    }
    constexpr double kLeast = 1e-6;  // of a channel's unit
    double& scale = scale_[static_cast<std::size_t>(k)];
    scale = std::max(kLeast, scale * std::sqrt(seen[k] / (due[k] * freedom)));
    if (!is_alike(k)) scale = std::max(scale, parts_.sampled_std[static_cast<std::size_t>(k)]);
  }
}

/// The scatter of an input that nobody tells: by how much more the residuals scatter along what it
/// changes than they would with it as it is.
void ResidualNoise::update_inputs(const Eigen::MatrixXd& left, double freedom) {
  for (std::size_t k = 0; k < parts_.inputs.size(); ++k) {
    if (!parts_.scatters_unknown[k]) continue;
    double seen = 0, due = 0;
    for (Eigen::Index w = 0; w < left.rows(); ++w) {
      const Eigen::MatrixXd& root = root_[static_cast<std::size_t>(w)];
      const Eigen::VectorXd column = root * parts_.inputs[k].row(w).transpose();
      const double known = column.squaredNorm(), along = column.dot(root * left.row(w).transpose());
      seen += std::min(along * along, kFar * kFar * known) / kOfNormal;
      due += known;
    }
    constexpr double kLeast = 0.01, kMost = 20;  // of what it was given by
    if (due > 0) {
      input_scale_[k] =
          std::clamp(input_scale_[k] * std::sqrt(seen / (due * freedom)), kLeast, kMost);
    }
  }
}

/// The scale of alike channels that neighbouring samples speak for; 0 where they say nothing.
double ResidualNoise::sampled_scale() const {
  std::vector<double> scales;
  for (Eigen::Index k = 0; k < parts_.residuals.cols(); ++k) {
    const auto channel = static_cast<std::size_t>(k);
    if (!is_alike(k)) continue;
    scales.push_back(parts_.sampled_std[channel] / std::hypot(1, share_[channel]));
  }
  return scales.empty() ? 0 : median_value(scales);
}

/// How far the scatter of alike channels goes with their size: what makes the residuals most
/// likely.
void ResidualNoise::choose_shares(const Eigen::MatrixXd& left) {
  double best = std::numeric_limits<double>::infinity(), chosen = 0, chosen_scale = 1;
  for (const double share : {0.0, 0.5, 1.0, 2.0, 6.0}) {
    std::vector<double> sizes;
    double misfit = 0;
    for (Eigen::Index k = 0; k < left.cols(); ++k) {
      if (!is_alike(k)) continue;
      for (Eigen::Index w = 0; w < left.rows(); ++w) {
        const double wide = std::hypot(1, share * parts_.reference(w, k));
        sizes.push_back(std::abs(left(w, k)) / wide);
        misfit += std::log(wide);
      }
    }
    if (sizes.empty()) return;
    const double scale = std::max(1e-9, median_value(sizes) / kMad);
    for (const double size : sizes) {
      const double z = size / scale;
      misfit += std::log(scale) + (z < kFar ? z * z / 2 : kFar * (z - kFar / 2));
    }
    if (misfit >= best) continue;
    best = misfit;
    chosen = share;
    chosen_scale = scale;
  }
  for (Eigen::Index k = 0; k < left.cols(); ++k) {
    if (!is_alike(k)) continue;
    share_[static_cast<std::size_t>(k)] = chosen;
    scale_[static_cast<std::size_t>(k)] = chosen_scale;
  }
}

void ResidualNoise::widen_what_goes_on(const Eigen::MatrixXd& left) {
  for (Eigen::Index k = 0; k < left.cols(); ++k) {
    std::vector<double> before, after;
    for (Eigen::Index w = 1; w < left.rows(); ++w) {
      if (!parts_.follows[static_cast<std::size_t>(w)]) continue;
      const auto clipped = [&](Eigen::Index at) {
        const double wide = std::sqrt(covariance_[static_cast<std::size_t>(at)](k, k));
        return std::clamp(left(at, k) / wide, -kFar, kFar);
      };
      before.push_back(clipped(w - 1));
      after.push_back(clipped(w));
    }
    if (before.size() < 10) continue;
    constexpr double kMost = 0.6;
    const double by_chance = 1 / std::sqrt(static_cast<double>(before.size()));
    const double rho = std::min(kMost, correlation(before, after));
    if (rho > by_chance) scale_[static_cast<std::size_t>(k)] *= std::sqrt((1 + rho) / (1 - rho));
  }
}

}  // namespace regoplan
