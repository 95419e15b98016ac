#include "drive_diagnosis/recording/robust_statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace regoplan {
namespace {

TEST(RobustStatistics, TheMedianIsTheMiddleWhateverTheEndsAre) {
  EXPECT_DOUBLE_EQ(median_value({3, -1e9, 1e9}), 3);
  EXPECT_DOUBLE_EQ(median_value({1, 2, 3, 100}), 2.5);
  EXPECT_DOUBLE_EQ(quantile_value({0, 10}, 0.25), 2.5);
}

TEST(RobustStatistics, ARatioStandsOneOutlierInFour) {
  EXPECT_DOUBLE_EQ(robust_ratio({1, 2, 3, 1}, {2, 4, 6, 90}), 2);
}

TEST(RobustStatistics, SamplesScatterAboutWhateverChangesSlowly) {
  constexpr double kScatter = 0.02;
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  std::vector<double> time_s, values, exact;
  for (int i = 0; i < 400; ++i) {
    time_s.push_back(i + 0.3 * (i % 3));
    exact.push_back(3 * std::sin(time_s.back() / 10) + 1e-6 * std::pow(time_s.back(), 3));
    values.push_back(exact.back() + kScatter * normal(random));
  }
  values[100] += 50;  // a jump
  EXPECT_NEAR(scatter_of_samples(time_s, values), kScatter, 0.15 * kScatter);
  EXPECT_LT(scatter_of_samples(time_s, exact), 0.1 * kScatter);
  EXPECT_EQ(scatter_of_samples({0, 1}, {0, 1}), 0);
}

TEST(RobustStatistics, WhatDoesNotVaryCorrelatesWithNothing) {
  EXPECT_DOUBLE_EQ(correlation({1, 2, 3}, {5, 5, 5}), 0);
  EXPECT_DOUBLE_EQ(correlation({1, 2, 3}, {-2, -4, -6}), -1);
}

}  // namespace
}  // namespace regoplan
