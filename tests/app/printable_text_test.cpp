#include "app/io/printable_text.h"

#include <gtest/gtest.h>

namespace regoplan {
namespace {

TEST(Printable, TextStaysAsItIs) {
  for (const char* text :
       {"", "scenario.yaml:3: x_m: -5", "Mondlandschaft für \xe6\x9c\x88 \xf0\x9f\x8c\x99"}) {
    EXPECT_EQ(printable(text), text);
  }
}

TEST(Printable, ATerminalObeysNothingOfIt) {
  EXPECT_EQ(printable("a\x1b[2Jb\rc\td\x7f"), R"(a\x1b[2Jb\x0dc\x09d\x7f)");
  EXPECT_EQ(printable(std::string_view("a\0b", 3)), R"(a\x00b)");
  EXPECT_EQ(printable("two\nlines"), "two lines");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            R"(\xc2\x9b31m)");  // the one-byte escape sequence
  EXPECT_EQ(printable("\xe2\x80\xae"
                      "txt"),
            R"(\xe2\x80\xaetxt)");  // right to left from here
}

TEST(Printable, BytesThatAreNoTextAreShownAsBytes) {
  EXPECT_EQ(printable("\xff\xc3("), R"(\xff\xc3()");
  EXPECT_EQ(printable("\xe2\x82"), R"(\xe2\x82)");
  EXPECT_EQ(printable("\xc0\xaf"), R"(\xc0\xaf)");  // longer than it need be
}

TEST(Printable, WhatIsTooLongKeepsItsPlaceAndItsEnd) {
  const std::string text = "f.yaml:3: key: " + std::string(300000, 'x') + " (allowed: above 0)";
  const std::string shown = printable(text);
  EXPECT_LT(shown.size(), 1100);
  EXPECT_TRUE(shown.starts_with("f.yaml:3: key: xxx")) << shown;
  EXPECT_TRUE(shown.ends_with("xxx (allowed: above 0)")) << shown;
  std::string umlauts;
  for (int i = 0; i < 5000; ++i) umlauts += "ü";
  EXPECT_EQ(printable(umlauts).find('\\'), std::string::npos);
  EXPECT_EQ(printable("x" + umlauts).find('\\'), std::string::npos);
}

TEST(Quotable, EndsWithAWholeCharacter) {
  EXPECT_EQ(quotable(""), "");
  EXPECT_EQ(quotable(std::string(40, 'x')), std::string(40, 'x'));
  EXPECT_EQ(quotable(std::string(39, 'x') + "üü"), std::string(39, 'x') + "...");
}

}  // namespace
}  // namespace regoplan
