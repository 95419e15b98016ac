#include "drive_diagnosis/contest/residual_noise.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "drive_diagnosis/recording/robust_statistics.h"

namespace regoplan {
namespace {

constexpr double kMad = 0.6745;     ///< median of |x| of a normal x
constexpr double kFar = 2.5;        ///< beyond, a residual counts less
constexpr double kOfNormal = 0.92;  ///< mean of min(x^2, kFar^2) of a normal x

/// How much there is of a source of scatter, and how much is due if it is as it is told.
class Evidence {
 public:
  /// \param along what is seen \param known its variance, as it is told \param weight of it
  void add(double along, double known, double weight = 1) {
    const double due = std::max(0.0, known);  // far residuals may take more than there is
    seen_ += weight * std::min(along * along, kFar * kFar * due) / kOfNormal;
    due_ += weight * due;
  }
  /// By what the source's deviation is to be multiplied.
  double factor() const { return due_ > 0 ? std::sqrt(seen_ / due_) : 1; }

 private:
  double seen_ = 0, due_ = 0;
};

}  // namespace

ResidualParts parts_of(const ResidualParts& all, const std::vector<Eigen::Index>& windows) {
  const auto some = [&windows](const Eigen::MatrixXd& of) -> Eigen::MatrixXd {
    return of(windows, Eigen::all);
  };
  ResidualParts parts{.residuals = some(all.residuals),
                      .columns = {},
                      .may_be_wrong = all.may_be_wrong,
                      .inputs = {},
                      .scatters_unknown = all.scatters_unknown,
                      .follows = {},
                      .sizes = some(all.sizes),
                      .sampled_std = all.sampled_std,
                      .more_std = some(all.more_std)};
  std::ranges::transform(all.columns, std::back_inserter(parts.columns), some);
  std::ranges::transform(all.inputs, std::back_inserter(parts.inputs), some);
  for (std::size_t i = 0; i < windows.size(); ++i) {
    parts.follows.push_back(i > 0 && windows[i] == windows[i - 1] + 1 &&
                            all.follows[static_cast<std::size_t>(windows[i])]);
  }
  return parts;
}

ResidualNoise::ResidualNoise(ResidualParts parts, ScatterSources sources)
    : parts_(std::move(parts)), sources_(std::move(sources)) {
  factor();
}

ResidualNoise::ResidualNoise(ResidualParts parts) : parts_(std::move(parts)) {
  start();
  constexpr int kRounds = 40;
  constexpr double kUnchanged = 0.01;  // of a deviation
  for (int round = 0; round < kRounds; ++round) {
    factor();
    if (update(fitted()) < kUnchanged) break;
  }
  factor();
  widen_what_goes_on(fitted().left);
  factor();
}

/// Floors begin with how residuals change from window to window, the share with that of a whole.
void ResidualNoise::start() {
  const Eigen::MatrixXd& residuals = parts_.residuals;
  sources_.inputs.assign(parts_.inputs.size(), 1);
  sources_.widened.assign(static_cast<std::size_t>(residuals.cols()), 1);
  double alike = 0, size = 0;
  Eigen::Index channels_alike = 0;
  for (Eigen::Index k = 0; k < residuals.cols(); ++k) {
    std::vector<double> steps;
    for (Eigen::Index i = 1; i < residuals.rows(); ++i) {
      if (!parts_.follows[static_cast<std::size_t>(i)]) continue;
      steps.push_back(std::abs(residuals(i, k) - residuals(i - 1, k)));
    }
    const double scale = steps.empty() ? 1 : median_value(steps) / kMad / std::sqrt(2);
    sources_.floor.push_back(std::max(least_floor(k), scale));
    if (!is_alike(k)) continue;
    ++channels_alike;
    alike += scale;
    size += parts_.sizes.col(k).mean();
  }
  for (Eigen::Index k = 0; k < residuals.cols(); ++k) {
    if (!is_alike(k)) continue;
    sources_.floor[static_cast<std::size_t>(k)] =
        std::max(least_floor(k), alike / static_cast<double>(channels_alike));
    sources_.share = alike / size;
  }
}

/// The least floor of a channel: what neighbouring samples say of it or, of alike channels, say in
/// the median. What goes together over some samples makes a mean scatter more.
double ResidualNoise::least_floor(Eigen::Index channel) const {
  constexpr double kLeast = 1e-6;  // of a channel's unit
  std::vector<double> sampled;
  for (Eigen::Index k = 0; k < parts_.residuals.cols(); ++k) {
    if (k != channel && !(is_alike(k) && is_alike(channel))) continue;
    sampled.push_back(parts_.sampled_std[static_cast<std::size_t>(k)]);
  }
  return std::max(kLeast, median_value(sampled));
}

Eigen::VectorXd ResidualNoise::variances(Eigen::Index window) const {
  Eigen::VectorXd result(parts_.residuals.cols());
  for (Eigen::Index k = 0; k < result.size(); ++k) {
    const auto channel = static_cast<std::size_t>(k);
    const double scale =
        sources_.widened[channel] *
        std::hypot(sources_.floor[channel], sources_.share * parts_.sizes(window, k));
    const double more = parts_.more_std(window, k);
    result[k] = scale * scale + more * more;
  }
  return result;
}

std::vector<double> ResidualNoise::scales() const {
  std::vector<double> result;
  for (Eigen::Index k = 0; k < parts_.residuals.cols(); ++k) {
    std::vector<double> of_windows;
    for (Eigen::Index w = 0; w < parts_.residuals.rows(); ++w)
      of_windows.push_back(variances(w)[k]);
    result.push_back(std::sqrt(median_value(of_windows)));
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
      const Eigen::VectorXd column = sources_.inputs[k] * parts_.inputs[k].row(w).transpose();
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
      const double variance = sources_.inputs[k] * sources_.inputs[k];
      result(w, static_cast<Eigen::Index>(k)) = variance * column.dot(white);
    }
  }
  return result;
}

/// The parameters are wider than those of a sound vehicle; far residuals count less.
ResidualNoise::Fitted ResidualNoise::fitted() const {
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
  Eigen::LLT<Eigen::MatrixXd> normal;
  constexpr int kRounds = 4;
  for (int round = 0; round < kRounds; ++round) {
    const Eigen::MatrixXd weighted = weights.asDiagonal() * design;
    normal.compute(design.transpose() * weighted + Eigen::MatrixXd::Identity(count, count));
    x = normal.solve(weighted.transpose() * data);
    const Eigen::VectorXd off = data - design * x;
    for (Eigen::Index i = 0; i < off.size(); ++i) {
      weights[i] = std::min(1.0, kFar / std::max(1e-12, std::abs(off[i])));
    }
  }
  Fitted result{.left = parts_.residuals, .known = {}};
  for (Eigen::Index c = 0; c < count; ++c) {
    result.left -= wider(c) * x[c] * parts_.columns[static_cast<std::size_t>(c)];
  }
  const Eigen::MatrixXd taken = normal.matrixL().solve(design.transpose());
  const Eigen::Index channels = parts_.residuals.cols();
  for (Eigen::Index w = 0; w < parts_.residuals.rows(); ++w) {
    const Eigen::MatrixXd& root = root_[static_cast<std::size_t>(w)];
    const Eigen::MatrixXd of_fit = taken.middleCols(w * channels, channels) * root;
    result.known.emplace_back(root.transpose() * root - of_fit.transpose() * of_fit);
  }
  return result;
}

/// Every source of scatter, by how much more what is left scatters, seen through all channels, than
/// it would with the source as it is told.
/// \returns the largest relative change of a deviation
double ResidualNoise::update(const Fitted& fitted) {
  std::vector<Evidence> of_floor(sources_.floor.size()), of_input(parts_.inputs.size());
  Evidence of_share, of_alike;
  for (Eigen::Index w = 0; w < fitted.left.rows(); ++w) {
    const Eigen::MatrixXd& root = root_[static_cast<std::size_t>(w)];
    const Eigen::MatrixXd& known = fitted.known[static_cast<std::size_t>(w)];
    const Eigen::VectorXd solved = root.transpose() * (root * fitted.left.row(w).transpose());
    for (Eigen::Index k = 0; k < fitted.left.cols(); ++k) {
      const double size = parts_.sizes(w, k);
      (is_alike(k) ? of_alike : of_floor[static_cast<std::size_t>(k)]).add(solved[k], known(k, k));
      of_share.add(solved[k], known(k, k), size * size);
    }
    for (std::size_t k = 0; k < parts_.inputs.size(); ++k) {
      const Eigen::VectorXd column = parts_.inputs[k].row(w).transpose();
      of_input[k].add(column.dot(solved), column.dot(known * column));
    }
  }
  double most = 0;
  const auto multiply = [&most](double& deviation, double by, double least, double longest) {
    const double before = deviation;
    deviation = std::clamp(deviation * by, least, longest);
    most = std::max(most, std::abs(deviation - before) / before);
  };
  constexpr double kAny = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < sources_.floor.size(); ++k) {
    const auto channel = static_cast<Eigen::Index>(k);
    const Evidence& evidence = is_alike(channel) ? of_alike : of_floor[k];
    multiply(sources_.floor[k], evidence.factor(), least_floor(channel), kAny);
  }
  constexpr double kLeastShare = 1e-4;
  if (sources_.share > 0) multiply(sources_.share, of_share.factor(), kLeastShare, kAny);
  constexpr double kLeastInput = 0.01, kMostInput = 20;  // of what it was given by
  for (std::size_t k = 0; k < parts_.inputs.size(); ++k) {
    if (!parts_.scatters_unknown[k]) continue;
    multiply(sources_.inputs[k], of_input[k].factor(), kLeastInput, kMostInput);
  }
  return most;
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
    if (rho > by_chance)
      sources_.widened[static_cast<std::size_t>(k)] = std::sqrt((1 + rho) / (1 - rho));
  }
}

}  // namespace regoplan
