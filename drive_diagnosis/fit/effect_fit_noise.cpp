// What EffectFit holds residuals against: how they scatter, and data and columns made white by it.
#include <numeric>
#include <utility>

#include "drive_diagnosis/fit/effect_fit.h"

namespace regoplan {

ResidualParts EffectFit::residual_parts(const LinearisedWindows& here) const {
  std::vector<Eigen::MatrixXd> global = here.columns;
  std::vector<bool> may_be_wrong = contest_.claimable;
  for (const std::vector<Eigen::MatrixXd>& numbers : here.zones) {
    for (const Eigen::MatrixXd& number : numbers) {
      global.push_back(number);
      may_be_wrong.push_back(true);
    }
  }
  std::vector<bool> unknown;
  for (std::size_t k = 0; k < here.inputs.size(); ++k) {
    unknown.push_back(k >= comparison_.slope_along());
  }
  Eigen::MatrixXd more_std = comparison_.more_std();
  if (border_std_.size() > 0) {
    more_std = (more_std.cwiseAbs2() + border_std_.cwiseAbs2()).cwiseSqrt();
  }
  constexpr double kAnything = 1e4;  // in any channel's unit
  for (const std::size_t w : silent_) {
    more_std.row(static_cast<Eigen::Index>(w)).setConstant(kAnything);
  }
  return {.residuals = here.data,
          .columns = std::move(global),
          .may_be_wrong = std::move(may_be_wrong),
          .inputs = here.inputs,
          .scatters_unknown = unknown,
          .follows = contest_.follows,
          .sizes = comparison_.sizes(),
          .sampled_std = comparison_.sampled_std(),
          .more_std = std::move(more_std)};
}

/// How far residuals scatter in the windows that do not touch a zone; nothing where those are too
/// few to tell.
std::optional<ScatterSources> EffectFit::scatter_outside(const LinearisedWindows& here,
                                                         const Eigen::VectorXd& zone) const {
  std::vector<Eigen::Index> outside;
  for (Eigen::Index w = 0; w < zone.size(); ++w) {
    if (zone[w] == 0) outside.push_back(w);
  }
  if (outside.size() < kFewestOutside) return std::nullopt;
  return ResidualNoise(parts_of(residual_parts(here), outside)).sources();
}

/// Makes data and columns of the contest white.
ResidualNoise EffectFit::whiten(const LinearisedWindows& here) {
  ResidualParts parts = residual_parts(here);
  ResidualNoise noise =
      scatter_ ? ResidualNoise(std::move(parts), *scatter_) : ResidualNoise(std::move(parts));
  noise_ = noise.scales();
  contest_.data = noise.whitened(here.data);
  contest_.parameters.resize(contest_.data.size(), static_cast<Eigen::Index>(here.columns.size()));
  for (std::size_t k = 0; k < here.columns.size(); ++k) {
    contest_.parameters.col(static_cast<Eigen::Index>(k)) = noise.whitened(here.columns[k]);
  }
  for (std::size_t z = 0; z < contest_.zones_known.size(); ++z) {
    Eigen::MatrixXd& known = contest_.zones_known[z].columns;
    known.resize(contest_.data.size(), static_cast<Eigen::Index>(numbers_.size()));
    for (std::size_t k = 0; k < numbers_.size(); ++k) {
      known.col(static_cast<Eigen::Index>(k)) = noise.whitened(here.zones[z][k]);
    }
  }
  const std::size_t along = comparison_.slope_along();
  const auto white = [&](std::size_t input) {
    return Eigen::VectorXd(noise.sources().inputs[input] * noise.whitened(here.inputs[input]));
  };
  const SlopeErrors errors{
      .along = white(along), .across = white(along + 1), .channels = here.base.cols()};
  for (std::size_t k = 0; k < slope_errors_.size(); ++k) {
    slope_errors_.at(k) = WindowComparison::kSlope * noise.sources().inputs[along + k];
  }
  contest_.ground = slope_error_columns(errors, contest_.follows, persistence(errors));
  return noise;
}

/// No soil changes the pitch, so it is asked first; where it scatters too far to tell, torques tell
/// slopes as well.
double EffectFit::persistence(const SlopeErrors& errors) const {
  std::vector<Eigen::Index> channels;
  if (const auto pitch = comparison_.channel("pitch_rad")) {
    channels.push_back(static_cast<Eigen::Index>(*pitch));
    const double told = likely_persistence(contest_, errors, channels);
    if (told < 1) return told;
  }
  channels.resize(static_cast<std::size_t>(errors.channels));
  std::iota(channels.begin(), channels.end(), 0);
  return likely_persistence(contest_, errors, channels);
}

/// Makes columns of soil of its own white.
void EffectFit::whiten_soil(const SoilColumns& soil, const ResidualNoise& noise) {
  const auto windows = static_cast<Eigen::Index>(comparison_.size());
  const auto numbers = static_cast<Eigen::Index>(numbers_.size());
  contest_.soil.resize(contest_.data.size(), windows * numbers);
  for (Eigen::Index k = 0; k < numbers; ++k) {
    for (Eigen::Index w = 0; w < windows; ++w) {
      contest_.soil.col(w * numbers + k) =
          noise.whitened(soil[static_cast<std::size_t>(k)][static_cast<std::size_t>(w)]);
    }
  }
}

}  // namespace regoplan
