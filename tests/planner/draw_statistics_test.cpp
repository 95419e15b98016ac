#include "planner/runtime/draw_statistics.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

namespace regoplan {
namespace {

constexpr QuantileInterval kEnds{.low = -1, .high = 1};

TEST(QuantileInterval, LiesBetweenTheOrderedDrawsThatTheBinomialNames) {
  // Of 100 draws the number below the 5 % quantile is 0 with .0059, at most 9 with .972, at most
  // 10 with .989: the first and the eleventh draw.
  std::vector<double> draws(100);
  std::iota(draws.begin(), draws.end(), 1.0);
  const QuantileInterval interval = quantile_interval(draws, 0.05, kEnds);
  EXPECT_EQ(interval.low, 1);
  EXPECT_EQ(interval.high, 11);
}

TEST(QuantileInterval, AFewDrawsLeaveItsEndsOpen) {
  const QuantileInterval one = quantile_interval({0.2}, 0.05, kEnds);
  EXPECT_EQ(one.low, -1);
  EXPECT_EQ(one.high, 1);
}

TEST(QuantileInterval, DrawsThatAreAllAlikeHaveNoSamplingError) {
  const QuantileInterval interval = quantile_interval(std::vector<double>(100, 0.3), 0.05, kEnds);
  EXPECT_EQ(interval.low, 0.3);
  EXPECT_EQ(interval.high, 0.3);
}

TEST(QuantileInterval, HoldsTheTrueQuantileAsOftenAsItSays) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0, 1);  // its 5 % quantile is .05
  int held = 0;
  constexpr int kTimes = 2000;
  for (int i = 0; i < kTimes; ++i) {
    std::vector<double> draws(200);
    for (double& draw : draws) draw = unit(random);
    const QuantileInterval interval = quantile_interval(draws, 0.05, {.low = 0, .high = 1});
    held += interval.low <= 0.05 && 0.05 <= interval.high;
  }
  EXPECT_GE(held, 0.945 * kTimes);
  EXPECT_LE(held, 0.99 * kTimes);
}

}  // namespace
}  // namespace regoplan
