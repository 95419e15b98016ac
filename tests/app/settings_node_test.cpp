#include "app/settings/settings_node.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/settings/settings_json.h"
#include "tests/error_text.h"
#include "tests/scratch_folder.h"

namespace regoplan {
namespace {

SettingsNode value(const std::string& yaml) {
  return parse_settings("key: " + yaml, "f.yaml").mapping().front().value;
}

std::string number_error(const std::string& yaml, const ValueRange& allowed = kAnyNumber) {
  return error_text([&] { value(yaml).number(allowed); });
}

TEST(SettingsNode, NumbersAreDecimal) {
  EXPECT_EQ(value("-1.5").number(kAnyNumber), -1.5);
  EXPECT_EQ(value(".036").number(kAnyNumber), 0.036);
  EXPECT_EQ(value("+8.14e5").number(kAnyNumber), 814000);
  for (const char* bad : {"five", "0x10", "1_000", "1,5", "1 m", "'5'", "\"5\"", "true", "1.2.3",
                          "+-1", "[1]", "{mean: 1}", "", "~"}) {
    EXPECT_NE(number_error(bad), "") << bad;
  }
}

TEST(SettingsNode, NanAndInfinitiesAreNoNumbers) {
  for (const char* bad : {".nan", ".NaN", "nan", ".inf", "-.inf", "inf", "1e999", "-1e999"}) {
    EXPECT_NE(number_error(bad), "") << bad;
  }
}

TEST(SettingsNode, AnErrorNamesFileLineKeyValueAndRange) {
  const SettingsNode root = parse_settings("vehicle:\n  name: x\n  mass_kg: -5\n", "scenario.yaml");
  EXPECT_EQ(error_text([&] { root.find("vehicle.mass_kg")->number(kAbove0); }),
            "scenario.yaml:3: vehicle.mass_kg: -5 is not valid (allowed: above 0)");
}

TEST(SettingsNode, AnErrorQuotesTheBeginningOfALongValue) {
  EXPECT_EQ(error_text([] { value(std::string(40, 'x')).mapping(); }),
            "f.yaml:1: key: " + std::string(40, 'x') +
                " is not valid (allowed: a mapping of keys to values)");
  EXPECT_EQ(number_error("\"" + std::string(41, 'x') + "\""),
            "f.yaml:1: key: \"" + std::string(40, 'x') +
                "...\" is not valid (allowed: any finite number)");
  // A table where settings are expected.
  std::string table = "time_s,x_m,y_m,z_m,yaw_deg,speed_mps,steer_deg\n";
  for (int i = 0; i < 1000; ++i) table += "0.6,7.02,7.02,0.61,44.9,0.12,-4.02\n";
  EXPECT_EQ(error_text([&] { parse_settings(table, "candidate-1.csv").mapping(); }),
            "candidate-1.csv:1: time_s,x_m,y_m,z_m,yaw_deg,speed_mps,ste... is not valid (allowed: "
            "a mapping of keys to values)");
}

TEST(SettingsNode, RangesAreKeptExactly) {
  const ValueRange open{.min = 0, .max = 60, .min_excluded = true};
  EXPECT_EQ(number_error("0", open), "f.yaml:1: key: 0 is not valid (allowed: above 0 to 60)");
  EXPECT_EQ(number_error("60.0001", open),
            "f.yaml:1: key: 60.0001 is not valid (allowed: above 0 to 60)");
  EXPECT_EQ(value("60").number(open), 60);
  EXPECT_EQ(value("0").number(kAtLeast0), 0);
}

TEST(SettingsNode, IntegersAreWhole) {
  EXPECT_EQ(value("12").integer(1, 20), 12);
  EXPECT_EQ(error_text([] { value("0").integer(1, 20); }),
            "f.yaml:1: key: 0 is not valid (allowed: a whole number, 1 to 20)");
  for (const char* bad : {"1.0", "1e3", "99999999999999999999", "'5'", "five"}) {
    EXPECT_NE(error_text([&] { value(bad).integer(0, INT64_MAX); }), "") << bad;
  }
}

TEST(SettingsNode, TruthIsTrueOrFalse) {
  EXPECT_TRUE(value("true").truth());
  EXPECT_FALSE(value("false").truth());
  EXPECT_EQ(error_text([] { value("yes").truth(); }),
            "f.yaml:1: key: yes is not valid (allowed: true | false)");
}

TEST(SettingsNode, AChoiceListsWhatThereIs) {
  EXPECT_EQ(value("b").choice({"a", "b"}), 1);
  EXPECT_EQ(error_text([] {
              value("c").choice({"a", "b"});
            }),
            "f.yaml:1: key: c is not valid (allowed: a | b)");
}

TEST(SettingsNode, AKeyGivenTwiceIsAnErrorAtAnyDepth) {
  EXPECT_EQ(error_text([] { parse_settings("a: 1\nb: 2\na: 3\n", "f.yaml"); }),
            "f.yaml:3: a: given twice (first in line 1)");
  EXPECT_EQ(error_text([] { parse_settings("l:\n  - m:\n      a: 1\n      a: 1\n", "f.yaml"); }),
            "f.yaml:4: l[0].m.a: given twice (first in line 3)");
}

TEST(SettingsNode, AMappingStandsWhereItsKeyStands) {
  const SettingsNode root = parse_settings("a: 1\nsoil:\n\n\n  n: 1\n", "f.yaml");
  EXPECT_EQ(root.find("soil")->line(), 2);
  EXPECT_EQ(root.find("soil.n")->line(), 5);
}

TEST(SettingsNode, AFieldIsFoundByPathByNameOfAListItemAndByFirstKey) {
  const SettingsNode root = parse_settings(
      "start: {x_m: 1}\ngoal:\n  x_m: 2\nwheels:\n  - {name: left, x_m: 3}\n"
      "  - {name: right, x_m: 4}\n",
      "f.yaml");
  EXPECT_EQ(root.find("goal.x_m")->number(kAnyNumber), 2);
  EXPECT_EQ(root.find("wheels.right.x_m")->number(kAnyNumber), 4);
  EXPECT_EQ(root.find("x_m")->number(kAnyNumber), 1);
  EXPECT_EQ(root.find("goal.radius_m"), root.find("goal"));
  EXPECT_EQ(root.find("nowhere"), nullptr);
}

TEST(SettingsNode, WhatIsNotOneYamlDocumentIsAnError) {
  EXPECT_NE(error_text([] { parse_settings("a: [1\nb: 2\n", "f.yaml"); }).find("f.yaml:2: "),
            std::string::npos);
  EXPECT_EQ(error_text([] { parse_settings("", "f.yaml"); }), "f.yaml: empty");
  EXPECT_EQ(error_text([] { parse_settings("# nothing\n", "f.yaml"); }), "f.yaml: empty");
  EXPECT_EQ(error_text([] { parse_settings("a: 1\n---\nb: 2\n", "f.yaml"); }),
            "f.yaml: 2 YAML documents (allowed: one)");
  EXPECT_NE(error_text([] { parse_settings("a: &x [*x]\n", "f.yaml"); }), "");
}

TEST(SettingsNode, AliasesAreRefusedBeforeTheyAreFollowed) {
  // Nine levels of ten aliases: 271 bytes that stand for 10^9 values.
  std::string levels = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int level = 1; level < 9; ++level) {
    levels += fmt::format("a{0}: &a{0} [*a{1}, *a{1}, *a{1}, *a{1}, *a{1}, *a{1}, *a{1}]\n", level,
                          level - 1);
  }
  EXPECT_EQ(error_text([&] { parse_settings(levels, "f.yaml"); }),
            "f.yaml:1: anchors and aliases (&name, *name) are not allowed; write it out");
  EXPECT_EQ(error_text([] { parse_settings("a: 1\nb:\n  - c: &x 1\n", "f.yaml"); }),
            "f.yaml:3: anchors and aliases (&name, *name) are not allowed; write it out");
}

TEST(SettingsNode, DepthNumberAndLengthAreBounded) {
  const auto nested = [](std::size_t depth) {
    return "a:\n  " + std::string(depth, '[') + std::string(depth, ']');
  };
  EXPECT_EQ(error_text([&] { parse_settings(nested(19), "f.yaml"); }), "");
  for (const std::size_t depth : {20, 400, 100000}) {
    EXPECT_TRUE(
        error_text([&] { parse_settings(nested(depth), "f.yaml"); }).starts_with("f.yaml:2: "))
        << depth;
  }
  std::string many = "a: [";
  for (int i = 0; i < 200000; ++i) many += "1,";
  EXPECT_EQ(error_text([&] { parse_settings(many + "1]", "f.yaml"); }),
            "f.yaml:1: too many values (allowed: 100000)");
  EXPECT_EQ(error_text([] { parse_settings("a: " + std::string(1 << 20, 'x'), "f.yaml"); }),
            "f.yaml: too long (allowed: 1048576 bytes)");
}

TEST(SettingsNode, AsJsonTextInQuotesStaysText) {
  const SettingsNode settings = parse_settings(
      "name: '2024'\nmass_kg: 2024\nsteered: true\nlabel: \"true\"\nsource: ''\nnothing:\n"
      "wheels: [lrv, 1e-3, '1e-3']\nlong: >-\n  12\n",
      "f.yaml");
  EXPECT_EQ(to_json(settings).dump(),
            R"({"name":"2024","mass_kg":2024,"steered":true,"label":"true","source":"",)"
            R"("nothing":null,"wheels":["lrv",0.001,"1e-3"],"long":"12"})");
}

TEST(SettingsNode, AsJsonWholeNumbersStayWhole) {
  const SettingsNode settings =
      parse_settings("{count: 400, length: 400.0, seed: -3, far: 1e3}", "f.yaml");
  EXPECT_EQ(to_json(settings).dump(), R"({"count":400,"length":400.0,"seed":-3,"far":1000.0})");
}

TEST(SettingsNode, AFileThatCannotBeReadIsAnError) {
  const ScratchFolder folder;
  EXPECT_EQ(error_text([&] { read_settings(folder.path("none.yaml")); }),
            folder.path("none.yaml") + ": no such file");
  EXPECT_EQ(error_text([&] { read_settings(folder.path("")); }), folder.path("") + ": is a folder");
  EXPECT_EQ(error_text([&] { read_settings(folder.write("e.yaml", "")); }),
            folder.path("e.yaml") + ": empty");
}

}  // namespace
}  // namespace regoplan
