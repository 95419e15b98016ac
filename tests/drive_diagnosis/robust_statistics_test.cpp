#include "drive_diagnosis/robust_statistics.h"

#include <gtest/gtest.h>

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

TEST(RobustStatistics, WhatDoesNotVaryCorrelatesWithNothing) {
  EXPECT_DOUBLE_EQ(correlation({1, 2, 3}, {5, 5, 5}), 0);
  EXPECT_DOUBLE_EQ(correlation({1, 2, 3}, {-2, -4, -6}), -1);
}

}  // namespace
}  // namespace regoplan
