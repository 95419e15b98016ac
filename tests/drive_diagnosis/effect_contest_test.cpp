#include "drive_diagnosis/contest/effect_contest.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstdint>
#include <random>

#include "terramech/basics/angles.h"

namespace regoplan {
namespace {

/// Eight windows with one white measurement each, of which the first number of a soil is seen, the
/// second not; the soil of windows 2 to 5 is free.
EffectContest with_a_known_zone(const Eigen::Vector2d& together, double first_number) {
  constexpr Eigen::Index kWindows = 8, kNumbers = 2;
  constexpr double kSensitivity = 10;  // standard errors for one deviation
  Eigen::VectorXd share = Eigen::VectorXd::Zero(kWindows);
  share.segment(2, 4).setOnes();
  EffectContest contest{.data = first_number * kSensitivity * share,
                        .parameters = Eigen::MatrixXd::Zero(kWindows, 0),
                        .soil = Eigen::MatrixXd::Zero(kWindows, kWindows * kNumbers),
                        .soil_numbers = kNumbers,
                        .wide_directions = {together},
                        .zones_known = {{.share = share, .columns = {}}}};
  for (Eigen::Index w = 0; w < kWindows; ++w) contest.soil(w, w * kNumbers) = kSensitivity;
  KnownZone& zone = contest.zones_known.front();
  zone.columns = Eigen::MatrixXd::Zero(kWindows, kNumbers);
  zone.columns.col(0) = kSensitivity * share;
  return contest;
}

TEST(FitContest, NumbersOfAZoneThatAreNotSeenGoWithThoseThatAre) {
  const ContestFit alone = fit_contest(with_a_known_zone(Eigen::Vector2d(0, 0), -5));
  EXPECT_NEAR(alone.zones[0][0], -5, 0.01);
  EXPECT_NEAR(alone.zones[0][1], 0, 1e-9);

  const ContestFit together = fit_contest(with_a_known_zone(Eigen::Vector2d(-6, -6), -5));
  EXPECT_NEAR(together.zones[0][0], -5, 0.01);
  EXPECT_NEAR(together.zones[0][1], -4.7, 0.1);              // 6^2 of 6^2 + 1.5^2 in common
  EXPECT_GT(together.zones_covariance[0](1, 1), 1.5 * 1.5);  // it may still be otherwise
}

/// A fault of 60 deviations of a sound vehicle, each as large as a standard error of eight windows.
TEST(FitContest, AFaultThatIsClaimedIsAsLargeAsItIsMeasured) {
  EffectContest contest{.data = Eigen::VectorXd::Constant(8, 60),
                        .parameters = Eigen::MatrixXd::Ones(8, 1),
                        .soil = Eigen::MatrixXd::Zero(8, 0)};
  EXPECT_LT(fit_contest(contest).parameters[0], 54);
  contest.faults_known = {0};
  const ContestFit claimed = fit_contest(contest);
  EXPECT_NEAR(claimed.parameters[0], 60, 0.1 * claimed.parameters_std[0]);
}

TEST(FitContest, ADeviationCostsByHowFarItIsFromWhatIsLikely) {
  const EffectContest contest = with_a_known_zone(Eigen::Vector2d(-6, -6), -5);
  const ContestFit nothing{.parameters = Eigen::VectorXd::Zero(0),
                           .zones = {Eigen::Vector2d(0, 0)}};
  ContestFit along = nothing, against = nothing;
  along.zones[0] = Eigen::Vector2d(-5, -5);
  against.zones[0] = Eigen::Vector2d(-5, 5);
  EXPECT_EQ(prior_nats(contest, nothing), 0);
  EXPECT_GT(prior_nats(contest, along), 0);
  EXPECT_GT(prior_nats(contest, against), 5 * prior_nats(contest, along));
}

/// Two drives of eight windows with one white measurement each; the last of the first drive and the
/// first four of the second are off alike, the former by half.
TEST(StrongestEffect, AZoneDoesNotBeginInAnotherDrive) {
  constexpr Eigen::Index kWindows = 16, kSecond = 8;
  constexpr double kSensitivity = 10;  // standard errors for one deviation
  EffectContest contest{.data = Eigen::VectorXd::Zero(kWindows),
                        .parameters = Eigen::MatrixXd::Zero(kWindows, 0),
                        .soil = kSensitivity * Eigen::MatrixXd::Identity(kWindows, kWindows),
                        .soil_numbers = 1,
                        .follows = std::vector<bool>(kWindows, true)};
  contest.data.segment(kSecond, 4).setConstant(2 * kSensitivity);
  contest.data[kSecond - 1] = kSensitivity;
  const EffectFound of_one = strongest_effect(contest, 1);
  ASSERT_TRUE(of_one.is_zone);
  EXPECT_DOUBLE_EQ(of_one.begins, kSecond - 0.5);

  contest.follows[0] = contest.follows[kSecond] = false;
  const EffectFound of_two = strongest_effect(contest, 1);
  ASSERT_TRUE(of_two.is_zone);
  EXPECT_DOUBLE_EQ(of_two.begins, kSecond);
  EXPECT_DOUBLE_EQ(of_two.ends, kSecond + 4);
}

/// Two faults that change what is measured in different ways, the first of them off by so many of
/// its standard errors; scatter of so much of what is told.
EffectContest with_a_fault(double standard_errors, double scatter) {
  constexpr Eigen::Index kMeasured = 200, kWindows = 10;
  constexpr double kSensitivity = 0.5;  // standard errors for what a sound vehicle is off
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd draws(kMeasured, 3);
  for (Eigen::Index i = 0; i < draws.size(); ++i) draws.data()[i] = normal(random);
  const Eigen::MatrixXd apart =
      draws.householderQr().householderQ() * Eigen::MatrixXd::Identity(kMeasured, 3);
  EffectContest contest{
      .data = standard_errors * apart.col(0) + scatter * std::sqrt(kMeasured) * apart.col(2),
      .parameters = kSensitivity * apart.leftCols(2),
      .claimable = {true, true},
      .soil = Eigen::MatrixXd::Zero(kMeasured, kWindows),
      .soil_numbers = 1,
      .wide_directions = {Eigen::VectorXd::Ones(1)},
      .follows = std::vector<bool>(kWindows, true)};
  return contest;
}

TEST(StrongestEffect, StandsOutBeyondWhatChanceGives) {
  constexpr std::uint64_t kSeed = 1;
  EXPECT_TRUE(strongest_effect(with_a_fault(4.2, 1), kSeed).stands_out);
  EXPECT_FALSE(strongest_effect(with_a_fault(3.2, 1), kSeed).stands_out);
}

/// White noise of the width that is told beside a fault of as many of its columns.
EffectContest with_noise(double size, std::uint64_t seed) {
  EffectContest contest = with_a_fault(0, 0);
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  for (double& value : contest.data) value = normal(random);
  contest.data += size * contest.parameters.col(0);
  return contest;
}

TEST(StrongestEffect, TellsFromWhichSizeOnFourOfFiveFaultsStandOut) {
  constexpr int kDraws = 200;
  const auto least = [](std::uint64_t seed) {
    return strongest_effect(with_noise(0, seed), 1).faults.at(0).least_shown;
  };
  double size = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) size += least(seed) / 10;
  int shown = 0, half_shown = 0;
  for (int i = 0; i < kDraws; ++i) {
    const auto seed = static_cast<std::uint64_t>(100 + i);
    shown += strongest_effect(with_noise(size, seed), 1).stands_out;
    half_shown += strongest_effect(with_noise(size / 2, seed), 1).stands_out;
  }
  EXPECT_NEAR(shown, 0.8 * kDraws, 0.09 * kDraws);  // three deviations of so many draws
  EXPECT_LT(half_shown, 0.1 * kDraws);
}

TEST(StrongestEffect, BesideAKnownOneMoreIsAskedAsItsFitIsNotExact) {
  EffectContest contest = with_a_fault(4.2, 1);
  contest.faults_known = {1};
  EXPECT_FALSE(strongest_effect(contest, 1).stands_out);
}

TEST(StrongestEffect, NamesThatChangeTheSameAreAClassUntilTheDataTellThemApart) {
  EffectContest contest = with_a_fault(20, 1);
  const Eigen::VectorXd named = contest.parameters.col(0), other = contest.parameters.col(1);
  const auto alike = [&](double angle_deg) {
    const double angle_rad = angle_deg * kDegree;
    contest.parameters.col(1) = std::cos(angle_rad) * named + std::sin(angle_rad) * other;
    const EffectFound found = strongest_effect(contest, 1);
    EXPECT_EQ(found.parameter, 0u) << angle_deg;
    std::vector<std::size_t> parameters;
    for (const FaultAlone& fault : found.alike) parameters.push_back(fault.parameter);
    return parameters;
  };
  EXPECT_EQ(alike(20), (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(alike(40), std::vector<std::size_t>{0});
  // Of a weak effect the same two are a class: evidence tells them no further apart.
  contest.data = with_a_fault(4.2, 1).data;
  EXPECT_EQ(alike(40), (std::vector<std::size_t>{0, 1}));
}

/// A second fault lends a third number what made it look like the first.
TEST(JudgedAnew, WhatAFaultIsHardlyToldFromIsJudgedWithTheOtherFaultsStanding) {
  EffectContest contest = with_a_fault(20, 1);
  const Eigen::Index measured = contest.data.size();
  const Eigen::MatrixXd apart = Eigen::MatrixXd(contest.parameters).householderQr().householderQ() *
                                Eigen::MatrixXd::Identity(measured, 4);
  const double first_size = contest.data.dot(apart.col(0)), second_size = 0.7 * first_size;
  contest.data += second_size * apart.col(1);
  contest.parameters.conservativeResize(Eigen::NoChange, 3);
  contest.parameters.col(1) = contest.parameters.col(0).norm() * apart.col(1);
  contest.parameters.col(2) = contest.parameters.col(0).norm() *
                              (0.7 * apart.col(0) + 0.6 * apart.col(1) + 0.39 * apart.col(3));
  contest.claimable = {true, true, true};
  const auto alike = [](const EffectFound& found) {
    std::vector<std::size_t> parameters;
    for (const FaultAlone& fault : found.alike) parameters.push_back(fault.parameter);
    return parameters;
  };
  EXPECT_EQ(alike(judged_anew(contest, 0, 1)), (std::vector<std::size_t>{0, 2}));
  contest.faults_known = {0, 1};
  const EffectFound anew = judged_anew(contest, 0, 1);
  EXPECT_EQ(alike(anew), std::vector<std::size_t>{0});
  EXPECT_EQ(anew.parameter, 0u);
  EXPECT_NEAR(anew.size * contest.parameters.col(0).norm(), std::abs(first_size),
              0.05 * std::abs(first_size));
}

/// Ten windows of twenty white measurements, each changed by a soil of its own; in two of them the
/// soil is otherwise by so many of its standard deviations.
EffectContest with_a_zone(double deviations) {
  constexpr Eigen::Index kWindows = 10, kOfEach = 20, kFirst = 4;
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  EffectContest contest{.data = Eigen::VectorXd::NullaryExpr(
                            kWindows * kOfEach, [&](Eigen::Index) { return normal(random); }),
                        .parameters = Eigen::MatrixXd::Zero(kWindows * kOfEach, 1),
                        .claimable = {true},
                        .soil = Eigen::MatrixXd::Zero(kWindows * kOfEach, kWindows),
                        .soil_numbers = 1,
                        .wide_directions = {Eigen::VectorXd::Ones(1)},
                        .follows = std::vector<bool>(kWindows, true)};
  for (Eigen::Index w = 0; w < kWindows; ++w) {
    contest.soil.col(w).segment(w * kOfEach, kOfEach).setConstant(0.3);
  }
  contest.data += deviations * contest.soil.middleCols(kFirst, 2).rowwise().sum();
  return contest;
}

TEST(StrongestEffect, AZoneIsAskedMoreThanChanceGivesSinceARecordingMayBeginOutOfBalance) {
  double deviations = 1;
  while (!strongest_effect(with_a_zone(deviations), 1).stands_out) deviations += 0.02;
  const EffectFound zone = strongest_effect(with_a_zone(deviations), 1);
  ASSERT_TRUE(zone.is_zone);
  constexpr double kOutOfBalance = 7, kMostToSpare = 10;  // twice nats
  EXPECT_GT(zone.gain, zone.chance + kOutOfBalance);
  EXPECT_LT(zone.gain, zone.chance + kMostToSpare);
}

TEST(ShortestZonesShown, AreThoseThatGainWhatIsAskedFourTimesOfFive) {
  constexpr Eigen::Index kWindows = 40, kFirst = 12;
  constexpr double kSensitivity = 1, kAsked = 25;
  constexpr double kSoil =
      2.5;  // deviations by which the likely soil is off; the other is not seen
  EffectContest contest{
      .data = Eigen::VectorXd::Zero(kWindows),
      .parameters = Eigen::MatrixXd::Zero(kWindows, 0),
      .soil = kSensitivity * Eigen::MatrixXd::Identity(kWindows, kWindows),
      .soil_numbers = 1,
      .likely_soils = {Eigen::VectorXd::Constant(1, kSoil), Eigen::VectorXd::Constant(1, 0.01)},
      .follows = std::vector<bool>(kWindows, true)};
  const auto shortest = shortest_zones_shown(contest, kAsked);
  ASSERT_EQ(shortest.size(), 2U);
  ASSERT_TRUE(shortest[0]);
  EXPECT_FALSE(shortest[1]);
  const auto gain_of = [&](int windows) {
    contest.data.setZero();
    contest.data.segment(kFirst, windows).setConstant(kSoil * kSensitivity);
    return strongest_effect(contest, 1).gain;
  };
  const auto shown_of_five = [&](int windows) {  // a gain scatters as the square of a normal number
    return 5 * std::erfc((std::sqrt(kAsked) - std::sqrt(gain_of(windows))) / std::sqrt(2.0)) / 2;
  };
  EXPECT_GT(shown_of_five(*shortest[0]), 4);
  EXPECT_LT(shown_of_five(*shortest[0] - 1), 4);
}

TEST(StrongestEffect, NoiseThatIsToldTooWideHidesNothing) {
  const EffectFound wide = strongest_effect(with_a_fault(3.4, 1), 1);
  const EffectFound narrow = strongest_effect(with_a_fault(3.4, 0.75), 1);
  EXPECT_FALSE(wide.stands_out);
  EXPECT_TRUE(narrow.stands_out);
  EXPECT_NEAR(narrow.std / wide.std, 0.75, 0.02);
}

}  // namespace
}  // namespace regoplan
