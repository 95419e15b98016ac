#include "drive_diagnosis/contest/held_out_stretches.h"

#include <gtest/gtest.h>

#include <cmath>

namespace regoplan {
namespace {

constexpr Eigen::Index kWindows = 10, kChannels = 2;
constexpr double kSensitivity = 1.5;  // standard errors for one deviation

/// A number that the first channel of each window shows as so many deviations off.
EffectContest shown(const Eigen::VectorXd& off) {
  EffectContest contest{.data = Eigen::VectorXd::Zero(off.size() * kChannels),
                        .parameters = Eigen::MatrixXd::Zero(off.size() * kChannels, 1)};
  for (Eigen::Index w = 0; w < off.size(); ++w) {
    contest.data[w * kChannels] = kSensitivity * off[w];
    contest.parameters(w * kChannels, 0) = kSensitivity;
  }
  return contest;
}

double nats(const Eigen::VectorXd& off) {
  return held_out_nats(shown(off), {0}, kChannels);
}

TEST(HeldOutNats, WhatAllStretchesShowAlikeIsPredictedAndWhatOneShowsAloneIsNot) {
  EXPECT_GT(nats(Eigen::VectorXd::Constant(kWindows, 1.0)), 0);
  // Two neighbours pull the number by half a deviation, and all the others contradict it.
  Eigen::VectorXd alone = Eigen::VectorXd::Zero(kWindows);
  alone.segment(4, 2).setConstant(3);
  EXPECT_LT(nats(alone), 0);
  const ContestFit fit = fit_contest(shown(alone));
  EXPECT_GT(fit.parameters[0], 0.5);
}

TEST(HeldOutNats, AreThoseOfANormalNumberThatTheOtherWindowsTell) {
  const Eigen::Vector2d off(1.2, 0.4);
  double expected = 0;
  for (const auto& [held_out, other] : {std::pair{off[0], off[1]}, {off[1], off[0]}}) {
    const double left = 1 / (1 + kSensitivity * kSensitivity);  // of the number's variance
    const double told = left * kSensitivity * kSensitivity * other;
    const double variance = 1 + kSensitivity * kSensitivity * left;
    const double away = kSensitivity * (held_out - told), as_said = kSensitivity * held_out;
    expected += (as_said * as_said - away * away / variance - std::log(variance)) / 2;
  }
  EXPECT_NEAR(nats(off), expected, 1e-9);
}

TEST(HeldOutNats, WhatOneWindowAloneShowsIsHeldAgainstNothing) {
  EXPECT_EQ(nats(Eigen::VectorXd::Constant(1, 3)), 0);
  EXPECT_EQ(held_out_nats(shown(Eigen::VectorXd::Constant(kWindows, 3)), {}, kChannels), 0);
}

}  // namespace
}  // namespace regoplan
