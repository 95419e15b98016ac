#include "drive_diagnosis/contest/residual_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "drive_diagnosis/recording/robust_statistics.h"

namespace regoplan {
namespace {

constexpr Eigen::Index kWindowCount = 60, kChannelsMeasured = 3;

/// Normal residuals, channel k with standard deviation k + 1.
Eigen::MatrixXd scattered(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd residuals(kWindowCount, kChannelsMeasured);
  for (Eigen::Index w = 0; w < kWindowCount; ++w) {
    for (Eigen::Index k = 0; k < kChannelsMeasured; ++k) {
      residuals(w, k) = static_cast<double>(k + 1) * normal(random);
    }
  }
  return residuals;
}

ResidualParts parts_with(
    const Eigen::MatrixXd& residuals,
    const Eigen::MatrixXd& more_std = Eigen::MatrixXd::Zero(kWindowCount, kChannelsMeasured)) {
  return {.residuals = residuals,
          .columns = {},
          .may_be_wrong = {},
          .inputs = {},
          .scatters_unknown = {},
          .follows = std::vector<bool>(kWindowCount, true),
          .sizes = Eigen::MatrixXd::Zero(kWindowCount, kChannelsMeasured),
          .sampled_std = std::vector<double>(kChannelsMeasured, 0.0),
          .more_std = more_std};
}

ResidualNoise noise_of(const Eigen::MatrixXd& residuals) {
  return ResidualNoise(parts_with(residuals));
}

TEST(ResidualNoise, IsAsWideAsEachChannelScatters) {
  // Residuals that go on from window to window by chance widen a scale: the middle of many counts.
  std::vector<std::vector<double>> ratios(kChannelsMeasured);
  for (std::uint64_t seed = 1; seed <= 21; ++seed) {
    const std::vector<double> scales = noise_of(scattered(seed)).scales();
    for (std::size_t k = 0; k < scales.size(); ++k) {
      ratios[k].push_back(scales[k] / static_cast<double>(k + 1));
    }
  }
  for (const std::vector<double>& of_channel : ratios) {
    EXPECT_NEAR(median_value(of_channel), 1, 0.12);
  }
}

TEST(ResidualNoise, OfOtherWindowsDoesNotTakeMisfitForScatter) {
  constexpr Eigen::Index kSound = 40;
  constexpr double kMisfit = 4;
  Eigen::MatrixXd residuals = scattered(2);
  residuals.bottomRows(kWindowCount - kSound) *= kMisfit;
  std::vector<Eigen::Index> sound(kSound);
  std::iota(sound.begin(), sound.end(), 0);
  const ResidualParts all = parts_with(residuals);
  const ResidualNoise of_sound(parts_of(all, sound));
  const ResidualNoise told(all, of_sound.sources());
  const ResidualNoise of_all(all);
  for (std::size_t k = 0; k < kChannelsMeasured; ++k) {
    EXPECT_NEAR(told.scales()[k], of_sound.scales()[k], 1e-12);
    EXPECT_GT(of_all.sources().floor[k], 1.3 * told.sources().floor[k]);
  }
}

/// Two channels that scatter by a floor and a share of their size, beside an input that scatters
/// far more; the sizes change between large and small from window to window.
struct OfTheirSize {
  static constexpr Eigen::Index kMany = 200;
  static constexpr double kLarge = 1.8, kSmall = 0.2;
  double floor = 0, share = 0, sampled_std = 0;

  ResidualNoise noise() const {
    std::mt19937_64 random(3);
    std::normal_distribution<double> normal;
    Eigen::MatrixXd residuals(kMany, 2), sizes(kMany, 2);
    Eigen::MatrixXd input = Eigen::MatrixXd::Constant(kMany, 2, 2);
    input.col(1) *= -1;
    for (Eigen::Index w = 0; w < kMany; ++w) {
      sizes.row(w).setConstant(w % 2 == 0 ? kLarge : kSmall);
      const double off = normal(random);
      for (Eigen::Index k = 0; k < 2; ++k) {
        residuals(w, k) =
            off * input(w, k) + floor * normal(random) + share * sizes(w, k) * normal(random);
      }
    }
    return ResidualNoise({.residuals = residuals,
                          .columns = {},
                          .may_be_wrong = {},
                          .inputs = {input},
                          .scatters_unknown = {false},
                          .follows = std::vector<bool>(kMany, true),
                          .sizes = sizes,
                          .sampled_std = {sampled_std, sampled_std},
                          .more_std = Eigen::MatrixXd::Zero(kMany, 2)});
  }
};

/// Of what both channels have in common, which the input leaves alone.
double std_told(const ResidualNoise& noise, Eigen::Index window) {
  const Eigen::VectorXd white = noise.whitened(Eigen::MatrixXd::Ones(OfTheirSize::kMany, 2));
  return std::sqrt(2) / white.segment(2 * window, 2).norm();
}

TEST(ResidualNoise, GoesWithTheSizeBesideInputsThatScatterMore) {
  const OfTheirSize truth{.share = 0.4};
  const ResidualNoise noise = truth.noise();
  EXPECT_NEAR(noise.sources().share, truth.share, 0.15 * truth.share);
  EXPECT_NEAR(std_told(noise, 0), truth.share * OfTheirSize::kLarge, 0.1);
}

TEST(ResidualNoise, HasAFloorThatDoesNotGoWithTheSize) {
  const OfTheirSize truth{.floor = 0.3, .share = 0.4};
  const ResidualNoise noise = truth.noise();
  EXPECT_NEAR(std_told(noise, 1), std::hypot(truth.floor, truth.share * OfTheirSize::kSmall), 0.05);
  EXPECT_NEAR(std_told(noise, 0), std::hypot(truth.floor, truth.share * OfTheirSize::kLarge), 0.1);
}

TEST(ResidualNoise, IsNowhereBelowWhatNeighbouringSamplesTell) {
  const OfTheirSize truth{.share = 0.4, .sampled_std = 0.25};
  EXPECT_GE(std_told(truth.noise(), 1), truth.sampled_std);
}

TEST(ResidualNoise, IsAsWideWhateverIsFitted) {
  // What is left of a fit scatters less than the noise: by a third of its variance here.
  constexpr Eigen::Index kParameters = 60;
  std::vector<double> scales;
  for (std::uint64_t seed = 1; seed <= 21; ++seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    ResidualParts parts{.residuals = scattered(seed),
                        .columns = {},
                        .may_be_wrong = std::vector<bool>(kParameters, true),
                        .inputs = {},
                        .scatters_unknown = {},
                        .follows = std::vector<bool>(kWindowCount, false),
                        .sizes = Eigen::MatrixXd::Zero(kWindowCount, kChannelsMeasured),
                        .sampled_std = std::vector<double>(kChannelsMeasured, 0.0),
                        .more_std = Eigen::MatrixXd::Zero(kWindowCount, kChannelsMeasured)};
    for (Eigen::Index i = 0; i < kParameters; ++i) {
      parts.columns.emplace_back(
          Eigen::MatrixXd::NullaryExpr(kWindowCount, kChannelsMeasured,
                                       [&](Eigen::Index, Eigen::Index) { return normal(random); }));
    }
    scales.push_back(ResidualNoise(std::move(parts)).scales()[0]);
  }
  EXPECT_NEAR(median_value(scales), 1, 0.12);
}

TEST(ResidualNoise, IsWiderInAWindowThatIsKnownToScatterMore) {
  Eigen::MatrixXd residuals = scattered(5);
  Eigen::MatrixXd more_std = Eigen::MatrixXd::Zero(kWindowCount, kChannelsMeasured);
  const Eigen::Index last = kWindowCount - 1;
  more_std(last, 0) = 4;
  residuals(last, 0) = 5;
  const Eigen::VectorXd alike = noise_of(residuals).whitened(residuals);
  const Eigen::VectorXd wider = ResidualNoise(parts_with(residuals, more_std)).whitened(residuals);
  EXPECT_GT(alike[kChannelsMeasured * last], 4);
  EXPECT_LT(wider[kChannelsMeasured * last], 1.3);
  // Other windows are as wide as they are without it.
  EXPECT_NEAR(wider[0] / alike[0], 1, 0.1);
}

TEST(ResidualNoise, IsLikelierToHaveLeftLess) {
  const Eigen::MatrixXd residuals = scattered(2);
  const ResidualNoise noise = noise_of(residuals);
  EXPECT_LT(noise.nats(residuals / 2), noise.nats(residuals));
  EXPECT_LT(noise.nats(residuals), noise.nats(1.5 * residuals));
}

TEST(ResidualNoise, OfTheFitThatLeavesLessIsTheLikelierOne) {
  // Each fit is held against the noise that it leaves: scatter doubled in one channel costs
  // log(2) nats a window.
  const Eigen::MatrixXd less = scattered(3);
  Eigen::MatrixXd more = less;
  more.col(1) *= 2;
  const double cost = noise_of(more).nats(more) - noise_of(less).nats(less);
  EXPECT_NEAR(cost, kWindowCount * std::log(2), 0.05 * kWindowCount);
}

TEST(ResidualNoise, CountsOneStrayWindowLittle) {
  const Eigen::MatrixXd residuals = scattered(4);
  const ResidualNoise noise = noise_of(residuals);
  Eigen::MatrixXd near = residuals, far = residuals;
  near(7, 0) = 10;
  far(7, 0) = 20;
  // Ten standard deviations more would cost 150 nats if they counted in full.
  EXPECT_LT(noise.nats(far) - noise.nats(near), 40);
}

}  // namespace
}  // namespace regoplan
