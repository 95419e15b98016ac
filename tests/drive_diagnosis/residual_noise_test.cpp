#include "drive_diagnosis/residual_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "drive_diagnosis/robust_statistics.h"

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

ResidualNoise noise_of(const Eigen::MatrixXd& residuals) {
  return ResidualNoise({.residuals = residuals,
                        .columns = {},
                        .may_be_wrong = {},
                        .inputs = {},
                        .scatters_unknown = {},
                        .follows = std::vector<bool>(kWindowCount, true),
                        .reference = Eigen::MatrixXd::Zero(kWindowCount, kChannelsMeasured),
                        .sampled_std = std::vector<double>(kChannelsMeasured, 0.0)});
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
