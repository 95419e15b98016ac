#include "terramech/tables/number_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "terramech/basics/angles.h"

namespace regoplan {
namespace {

TEST(NumberText, DegreesThatWereReadAreWrittenAsTheyWereGiven) {
  for (const double degrees : {37.2, 35.0, 0.1, 16.0, 22.5, 0.0, 33.333}) {
    EXPECT_EQ(*parse_number(number_in_unit(degrees * kDegree, kDegree)), degrees);
  }
  EXPECT_EQ(number_in_unit(37.2 * kDegree, kDegree), "37.2");
}

TEST(NumberText, ANumberInSiReadsBackBitForBit) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-300, 300);
  for (int i = 0; i < 1000; ++i) {
    const double value = std::pow(10, exponent(random));
    EXPECT_EQ(*parse_number(number_in_unit(value, 1)), value);
  }
}

TEST(NumberText, OnlyFiniteDecimalNumbersAreNumbers) {
  for (const char* bad :
       {"", "+", "-", ".", "e5", "nan", "inf", "1e999", "0x1", " 1", "1 ", "1m"}) {
    EXPECT_FALSE(parse_number(bad)) << bad;
  }
}

}  // namespace
}  // namespace regoplan
