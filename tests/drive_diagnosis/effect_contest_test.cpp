#include "drive_diagnosis/effect_contest.h"

#include <gtest/gtest.h>

namespace regoplan {
namespace {

/// Eight windows with one white measurement each, of which the first number of a soil is seen, the
/// second not; the soil of windows 2 to 5 is free.
EffectContest with_a_known_zone(const Eigen::Vector2d& common_direction, double first_number) {
  constexpr Eigen::Index kWindows = 8, kNumbers = 2;
  constexpr double kSensitivity = 10;  // standard errors for one deviation
  Eigen::VectorXd share = Eigen::VectorXd::Zero(kWindows);
  share.segment(2, 4).setOnes();
  EffectContest contest{.data = first_number * kSensitivity * share,
                        .parameters = Eigen::MatrixXd::Zero(kWindows, 0),
                        .soil = Eigen::MatrixXd::Zero(kWindows, kWindows * kNumbers),
                        .soil_numbers = kNumbers,
                        .common_direction = common_direction,
                        .zones_known = {share}};
  for (Eigen::Index w = 0; w < kWindows; ++w) contest.soil(w, w * kNumbers) = kSensitivity;
  return contest;
}

TEST(FitContest, NumbersOfAZoneThatAreNotSeenGoWithThoseThatAre) {
  const ContestFit alone = fit_contest(with_a_known_zone(Eigen::Vector2d(0, 0), -5));
  EXPECT_NEAR(alone.zones[0][0], -5, 0.01);
  EXPECT_NEAR(alone.zones[0][1], 0, 1e-9);

  const ContestFit together = fit_contest(with_a_known_zone(Eigen::Vector2d(-1, -1), -5));
  EXPECT_NEAR(together.zones[0][0], -5, 0.01);
  EXPECT_NEAR(together.zones[0][1], -4, 0.1);  // 6^2 of 6^2 + 3^2 in common
  EXPECT_GT(together.zones_std[0][1], 3);      // by itself it may still be otherwise
}

TEST(FitContest, ADeviationCostsByHowFarItIsFromWhatIsLikely) {
  const EffectContest contest = with_a_known_zone(Eigen::Vector2d(-1, -1), -5);
  const ContestFit nothing{.parameters = Eigen::VectorXd::Zero(0),
                           .zones = {Eigen::Vector2d(0, 0)}};
  ContestFit along = nothing, against = nothing;
  along.zones[0] = Eigen::Vector2d(-5, -5);
  against.zones[0] = Eigen::Vector2d(-5, 5);
  EXPECT_EQ(prior_nats(contest, nothing), 0);
  EXPECT_GT(prior_nats(contest, along), 0);
  EXPECT_GT(prior_nats(contest, against), 5 * prior_nats(contest, along));
}

}  // namespace
}  // namespace regoplan
