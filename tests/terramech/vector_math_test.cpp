#include "terramech/basics/vector_math.h"

#include <gtest/gtest.h>

#include <cmath>

namespace regoplan::vector_math {
namespace {

double lane(Vec v) {
  return v[0];
}
Vec all(double x) {
  return Vec{x, x, x, x};
}

}  // namespace

TEST(VectorMath, ExponentialIsWithinElevenBillionthsRelative) {
  for (double x = -690; x <= 690; x += 0.0371) {
    EXPECT_NEAR(lane(exp(all(x))) / std::exp(x), 1, 1.1e-8) << x;
  }
}

TEST(VectorMath, ExponentialOfNothingIsOneAndKeepsTheSignOfTinyArguments) {
  EXPECT_EQ(lane(exp(all(0))), 1);
  for (const double x : {1e-3, 1e-8, 1e-15}) {
    EXPECT_NEAR((1 - lane(exp(all(-x)))) / x, 1, 0.13) << x;
    EXPECT_GT(1 - lane(exp(all(-x))), 0) << x;
  }
}

TEST(VectorMath, ExponentialFarBelowCountsAsMinusSevenHundred) {
  EXPECT_GT(lane(exp(all(-1e15))), 0);
  EXPECT_LT(lane(exp(all(-1e15))), 1e-300);
}

TEST(VectorMath, LogarithmIsWithinThreeTenthsOfABillionth) {
  for (double x = 1e-300; x < 1e300; x *= 1.37) {
    EXPECT_NEAR(lane(log(all(x))), std::log(x), 3e-10 + 1e-15 * std::abs(std::log(x))) << x;
  }
}

TEST(VectorMath, LogarithmOfFloatsIsWithinThreeTenthsOfAMillionth) {
  for (double x = 1e-30; x < 1e30; x *= 1.0137) {
    const auto number = static_cast<float>(x);
    const double log = std::log(double{number});
    const auto four = log_of_floats(Four{} + number);
    EXPECT_NEAR(double{four[2]}, log, 3e-7 * std::max(1.0, std::abs(log))) << x;
    const auto eight = log_of_floats(Eight{} + number);
    EXPECT_EQ(eight[7], four[0]) << x;
  }
}

TEST(VectorMath, TurnKeepsItsRelativeAccuracyAtSmallAngles) {
  for (double d = 1e-9; d <= 3.7; d *= 1.01) {
    const double bound = d <= 2.2 ? 2e-10 : 1e-7;
    const double versin = 2 * std::pow(std::sin(d / 2), 2);
    EXPECT_NEAR(lane(turn(all(d)).versin) / versin, 1, bound) << d;
    EXPECT_NEAR(lane(turn(all(d)).sin), std::sin(d), bound * std::min(d, 1.0)) << d;
  }
}

TEST(VectorMath, SignIsCarriedOver) {
  const Vec v = with_sign(Vec{1, 2, 3, 4}, Vec{-1, 1, -0.0, 0.0});
  EXPECT_EQ(v[0], -1);
  EXPECT_EQ(v[1], 2);
  EXPECT_EQ(v[2], -3);
  EXPECT_EQ(v[3], 4);
  EXPECT_EQ(sum(abs(v)), 10);
}

}  // namespace regoplan::vector_math
