#include "app/io/quantity_text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <limits>
#include <string>

namespace regoplan {
namespace {

TEST(QuantityText, HasThreeSignificantDigitsInTheUnitThatFits) {
  EXPECT_EQ(energy_text(0.0123), "12.3 mJ");
  EXPECT_EQ(energy_text(1), "1.00 J");
  EXPECT_EQ(energy_text(87.34), "87.3 J");
  EXPECT_EQ(energy_text(1204), "1.20 kJ");
  EXPECT_EQ(energy_text(45e6), "45.0 MJ");
  EXPECT_EQ(energy_text(-87.34), "-87.3 J");
  EXPECT_EQ(length_text(0.000412), "0.412 mm");
  EXPECT_EQ(length_text(0.0412), "41.2 mm");
  EXPECT_EQ(length_text(1.3), "1.30 m");
  EXPECT_EQ(length_text(2500), "2.50 km");
}

TEST(QuantityText, NothingIsNothingAndWhatIsNotKnownADash) {
  EXPECT_EQ(energy_text(0), "0 J");
  EXPECT_EQ(length_text(0), "0 m");
  EXPECT_EQ(energy_text(std::numeric_limits<double>::quiet_NaN()), kNotKnown);
}

TEST(QuantityText, WhatRoundingLeavesHasNoDigits) {
  EXPECT_EQ(length_text(7.11e-15), "<0.001 mm");
  EXPECT_EQ(energy_text(-7.11e-15), "<0.001 mJ");
  EXPECT_EQ(length_text(1.2e-6), "0.00120 mm");
}

TEST(QuantityText, NothingThatIsThereReadsAsZeroOrNeedsAFourthDigit) {
  for (double value = 1e-5; value < 1e9; value *= 1.01) {
    const std::string text = energy_text(value);
    const double shown = std::stod(text);
    EXPECT_GT(shown, 0) << value;
    EXPECT_LE(
        std::count_if(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c); }),
        value < 1e-3 ? 6 : 4)
        << text;
  }
}

}  // namespace
}  // namespace regoplan
