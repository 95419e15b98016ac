#include "diagnosis/fit/evidence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace regoplan {
namespace {

TestBed small_bed(std::size_t conditions) {
  TestBed bed;
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  for (std::size_t k = 0; k < conditions; ++k) {
    bed.conditions.push_back({.load_n = 50.0 + static_cast<double>(k % 3) * 20,
                              .slip_ratio = 0.1 * static_cast<double>(k % 7),
                              .slip_angle_rad = 0.05 * static_cast<double>(k % 4)});
  }
  for (const Channel channel : {Channel::kFx, Channel::kFy}) {
    ChannelData& data = bed.channels.emplace_back();
    data.channel = channel;
    data.scale = 1;
    const auto n = static_cast<Eigen::Index>(conditions);
    data.mean.resize(n);
    for (double& y : data.mean) y = normal(random);
    data.noise = 0.5 * Eigen::MatrixXd::Identity(n, n);
    for (std::size_t k = 0; k < conditions; ++k) data.conditions.push_back(k);
  }
  return bed;
}

Linearised some_model(const TestBed& bed) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  Linearised model{.residual = bed.measured(), .jacobian = Eigen::MatrixXd(bed.size(), 3)};
  for (double& value : model.jacobian.reshaped()) value = normal(random);
  return model;
}

double log_normal_density(const Eigen::VectorXd& y, const Eigen::MatrixXd& covariance) {
  const Eigen::LLT<Eigen::MatrixXd> factor(covariance);
  return -0.5 * (y.dot(factor.solve(y)) + 2 * factor.matrixLLT().diagonal().array().log().sum() +
                 static_cast<double>(y.size()) * std::log(2 * std::numbers::pi));
}

/// Weights that leave only the setting without discrepancy.
SettingWeights noise_only() {
  SettingWeights weights;
  weights.log_weight.assign(discrepancy_settings().size(), -1e300);
  weights.log_weight.front() = 0;
  return weights;
}

TEST(Evidence, IsTheDensityOfTheDataUnderPriorAndNoise) {
  const TestBed bed = small_bed(14);
  const Discrepancy discrepancy(bed);
  const Linearised model = some_model(bed);
  const Evidence evidence =
      evidence_of(bed, discrepancy, model, Eigen::MatrixXd(bed.size(), 0), noise_only());
  const Eigen::MatrixXd covariance = 0.5 * Eigen::MatrixXd::Identity(bed.size(), bed.size()) +
                                     model.jacobian * model.jacobian.transpose();
  EXPECT_NEAR(evidence.log_marginal, log_normal_density(model.residual, covariance), 1e-8);
}

TEST(Evidence, ADiscrepancyKeptOffTheSoilLeavesTheSoilAsItIsWithout) {
  const TestBed bed = small_bed(20);
  const Discrepancy discrepancy(bed);
  const Linearised model = some_model(bed);
  SettingWeights one;
  one.log_weight.assign(discrepancy_settings().size(), -1e300);
  one.log_weight[0] = -1e100;  // possible, never chosen
  one.log_weight[11] = 0;
  Linearised strong = model;
  strong.jacobian *= 30;
  const Eigen::MatrixXd directions = soil_directions(bed, strong.jacobian);
  ASSERT_EQ(directions.cols(), 3);
  const Eigen::MatrixXd none(bed.size(), 0);
  const double kept_off = evidence_of(bed, discrepancy, strong, directions, one).covariance(0, 0);
  const double free = evidence_of(bed, discrepancy, strong, none, one).covariance(0, 0);
  const double without = evidence_of(bed, discrepancy, strong, none, noise_only()).covariance(0, 0);
  EXPECT_LT(kept_off, free);
  EXPECT_NEAR(kept_off, without, 0.1 * without);
}

TEST(Evidence, OfManyResidualsIsThatOfEach) {
  const TestBed bed = small_bed(20);
  const Discrepancy discrepancy(bed);
  const Linearised model = some_model(bed);
  const Eigen::MatrixXd directions = soil_directions(bed, 30 * model.jacobian);
  Eigen::MatrixXd residuals(bed.size(), 3);
  residuals << model.residual, 4 * model.residual.reverse(), 9 * model.jacobian.col(0);
  const SettingWeights weights = SettingWeights::of_unexplained();
  const std::vector<Evidence> all =
      evidence_of(bed, discrepancy, WhitenedResiduals(bed, discrepancy, residuals, weights),
                  model.jacobian, directions, weights);
  ASSERT_EQ(all.size(), 3U);
  for (Eigen::Index r = 0; r < residuals.cols(); ++r) {
    const Evidence one =
        evidence_of(bed, discrepancy, {residuals.col(r), model.jacobian}, directions, weights);
    const Evidence& of_many = all[static_cast<std::size_t>(r)];
    EXPECT_NEAR(of_many.log_marginal, one.log_marginal, 1e-9);
    EXPECT_EQ(of_many.settings, one.settings);
    EXPECT_TRUE(of_many.x.isApprox(one.x, 1e-9));
  }
}

TEST(Discrepancy, OfTheSideForceIsOddAndVanishesStraightAhead) {
  const DiscrepancyScales scales;
  const Condition left{.load_n = 60, .slip_angle_rad = 0.2};
  const Condition right{.load_n = 60, .slip_angle_rad = -0.2};
  const Condition straight{.load_n = 60};
  EXPECT_LT(discrepancy_kernel(scales, Channel::kFy, left, right), 0);
  EXPECT_EQ(discrepancy_kernel(scales, Channel::kFy, left, straight), 0);
  EXPECT_EQ(discrepancy_kernel(scales, Channel::kFx, left, right), 1);
}

/// The sides of the likeliest discrepancy of a side force that a cosine or a sine of the slip angle
/// is missing of.
Sides sides_of_missing(double (*missing)(double)) {
  TestBed bed = small_bed(28);
  bed.channels.erase(bed.channels.begin());
  ChannelData& side_force = bed.channels.front();
  for (std::size_t k = 0; k < bed.conditions.size(); ++k) {
    bed.conditions[k].slip_angle_rad = 0.05 * (static_cast<double>(k % 8) - 3.5);
    side_force.mean[static_cast<Eigen::Index>(k)] +=
        20 * missing(5 * bed.conditions[k].slip_angle_rad);
  }
  const Linearised nothing{.residual = bed.measured(), .jacobian = Eigen::MatrixXd(bed.size(), 0)};
  const Evidence evidence =
      evidence_of(bed, Discrepancy(bed), nothing, Eigen::MatrixXd(bed.size(), 0),
                  SettingWeights::of_unexplained());
  return discrepancy_settings()[evidence.settings.front()].sides;
}

/// No level soil pushes a wheel to one side whichever way it slips: what does is no smooth physics
/// of the wheel alone, and a name needs to be better than that.
TEST(Evidence, HasTheSidesApartWhereTheBedPushesToOneSide) {
  EXPECT_EQ(sides_of_missing(std::cos), Sides::kApart);
  EXPECT_EQ(sides_of_missing(std::sin), Sides::kMirrored);
}

}  // namespace
}  // namespace regoplan
