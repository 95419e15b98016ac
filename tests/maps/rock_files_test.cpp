#include "maps/rock_files.h"

#include <gtest/gtest.h>

#include "terramech/basics/input_error.h"
#include "tests/scratch_folder.h"

namespace regoplan {
namespace {

std::string refusal(const std::string& file) {
  try {
    read_rocks(file);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(RockFiles, WhatIsWrittenReadsBackExactly) {
  const ScratchFolder folder;
  const std::vector<Rock> rocks{{0.1, -1e7 / 3, 1e-3, 2}, {8142406.123456789, 5, 0.5, 0.25}};
  write_rocks(rocks, folder.path("rocks.csv"));
  EXPECT_EQ(read_rocks(folder.path("rocks.csv")), rocks);
  write_rocks({}, folder.path("rocks.csv"));
  EXPECT_TRUE(read_rocks(folder.path("rocks.csv")).empty());
  EXPECT_EQ(folder.count(), 1);
}

TEST(RockFiles, ColumnsMayStandInAnyOrderWithOthersBetween) {
  const ScratchFolder folder;
  const std::string file = folder.write(
      "r.csv", "\xEF\xBB\xBFname, height_m ,\"y_m\",x_m,radius_m\r\nbig,4,3, 1 ,2\r\n\r\n");
  EXPECT_EQ(read_rocks(file), (std::vector<Rock>{{1, 3, 2, 4}}));
  const std::string quoted = folder.write(
      "q.csv", "\xEF\xBB\xBF\"x_m\",y_m,radius_m,height_m,name,\n\n1,3,2,\"4\",\"a, b\",\n,,,,,\n");
  EXPECT_EQ(read_rocks(quoted), (std::vector<Rock>{{1, 3, 2, 4}}));
}

TEST(RockFiles, ErrorsNameFileLineColumnAndValue) {
  const ScratchFolder folder;
  const std::string header = "x_m,y_m,radius_m,height_m\n";
  const auto says = [&](const std::string& text, const std::string& words) {
    const std::string message = refusal(folder.write("r.csv", text));
    return message.find(words) != std::string::npos
               ? testing::AssertionSuccess()
               : testing::AssertionFailure() << message << "\n  does not say: " << words;
  };
  EXPECT_TRUE(says(header + "1,2,3,4\n1,2,0,4\n",
                   "r.csv:3: radius_m: 0 is not valid (allowed: above 0 to 1000000000000)"));
  EXPECT_TRUE(says(header + "1,2,3,-4\n", "r.csv:2: height_m: -4 is not valid"));
  EXPECT_TRUE(says(header + "1,nan,3,4\n", "r.csv:2: y_m: nan is not valid"));
  EXPECT_TRUE(says(header + "1 m,2,3,4\n", "r.csv:2: x_m: 1 m is not valid"));
  EXPECT_TRUE(says(header + "1,,3,4\n", "r.csv:2: y_m: an empty cell is not valid"));
  EXPECT_TRUE(says(header + "1,2,3\n", "r.csv:2: 3 cells (the header has 4)"));
  EXPECT_TRUE(says("x_m,y_m,radius_m,height\n1,2,3,4\n",
                   "r.csv:1: column height_m is missing (the header has height)"));
  EXPECT_TRUE(says("x_m,y_m,radius_m,height_m,x_m\n", "r.csv:1: column x_m given twice"));
  EXPECT_TRUE(says("x_m;y_m;radius_m;height_m\n", "cells are separated by semicolons"));
  EXPECT_TRUE(says("", "r.csv: empty (expected a header line)"));
  EXPECT_NE(refusal(folder.path("none.csv")).find("none.csv: no such file"), std::string::npos);
  EXPECT_EQ(refusal(folder.path("")), folder.path("") + ": is a folder");
}

TEST(RockFiles, NothingIsLeftWhereNothingCanBeWritten) {
  const ScratchFolder folder;
  EXPECT_THROW(write_rocks({}, folder.path("no/such/folder.csv")), InputError);
  std::filesystem::create_directory(folder.path("folder"));
  EXPECT_THROW(write_rocks({}, folder.path("folder")), InputError);
  EXPECT_EQ(folder.count(), 1);
}

}  // namespace
}  // namespace regoplan
