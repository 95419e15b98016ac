#include "drive_diagnosis/contest/slope_errors.h"

#include <gtest/gtest.h>

#include <random>

namespace regoplan {
namespace {

constexpr Eigen::Index kWindows = 60;

/// Windows of one channel that slopes change, measured to a tenth of what they err.
struct Drive {
  std::vector<bool> follows = std::vector<bool>(kWindows, true);
  SlopeErrors errors{.along = Eigen::VectorXd::Constant(kWindows, 10),
                     .across = Eigen::VectorXd::Zero(kWindows),
                     .channels = 1};
  Drive() { follows.front() = false; }
  Eigen::MatrixXd covariance(double persistent) const {
    const Eigen::MatrixXd columns = slope_error_columns(errors, follows, persistent);
    return columns * columns.transpose() / 100;
  }
};

TEST(SlopeErrors, EachWindowsSlopeErrsAsMuchAsIsSaid) {
  for (const double persistent : {0.0, 0.3, 1.0}) {
    EXPECT_TRUE(Drive().covariance(persistent).diagonal().isApproxToConstant(1, 1e-9));
  }
}

TEST(SlopeErrors, OverALongStretchSlopesThatDoNotPersistErrNoMoreThanOverOneWindow) {
  const Drive drive;
  const auto of_stretch = [&](double persistent) {
    return drive.covariance(persistent).topLeftCorner(20, 20).sum();
  };
  EXPECT_NEAR(of_stretch(0), 1, 1e-9);  // the difference of two heights
  EXPECT_NEAR(of_stretch(1), 20, 1e-9);
}

TEST(SlopeErrors, NothingGoesOnAcrossAGap) {
  Drive drive;
  drive.follows[20] = false;
  const Eigen::MatrixXd covariance = drive.covariance(0);
  EXPECT_EQ(covariance(19, 20), 0);
  EXPECT_NEAR(covariance(20, 21), -0.5, 1e-9);
}

TEST(SlopeErrors, WhatIsMeasuredTellsWhetherTheyPersist) {
  const Drive drive;
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (const double persistent : {0.1, 1.0}) {
    const Eigen::MatrixXd columns = slope_error_columns(drive.errors, drive.follows, persistent);
    Eigen::VectorXd data = Eigen::VectorXd::NullaryExpr(kWindows, [&] { return normal(random); });
    data += columns * Eigen::VectorXd::NullaryExpr(columns.cols(), [&] { return normal(random); });
    const EffectContest contest{.data = std::move(data),
                                .parameters = Eigen::MatrixXd::Zero(kWindows, 0),
                                .follows = drive.follows};
    EXPECT_EQ(likely_persistence(contest, drive.errors, {0}), persistent);
    EXPECT_EQ(likely_persistence(contest, drive.errors, {}), 1) << "as nothing was asked";
  }
}

TEST(SlopeErrors, AZoneThatIsFreeIsNotTakenForSlopesThatPersist) {
  constexpr Eigen::Index kFirst = 20, kLong = 12;
  Drive drive;
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  const Eigen::MatrixXd columns = slope_error_columns(drive.errors, drive.follows, 0.1);
  Eigen::VectorXd share = Eigen::VectorXd::Zero(kWindows);
  share.segment(kFirst, kLong).setOnes();
  constexpr double kOff = 15;  // by which soil changes each of its windows, in what scatters
  EffectContest contest{
      .data =
          columns * Eigen::VectorXd::NullaryExpr(columns.cols(), [&] { return normal(random); }) +
          Eigen::VectorXd::NullaryExpr(kWindows, [&] { return normal(random); }) + kOff * share,
      .parameters = Eigen::MatrixXd::Zero(kWindows, 0),
      .soil_numbers = 1,
      .wide_directions = {Eigen::VectorXd::Ones(1)},
      .follows = drive.follows};
  EXPECT_EQ(likely_persistence(contest, drive.errors, {0}), 1);
  contest.zones_known.push_back({.share = share, .columns = kOff * share});
  EXPECT_EQ(likely_persistence(contest, drive.errors, {0}), 0.1);
}

}  // namespace
}  // namespace regoplan
