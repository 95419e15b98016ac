#include "app/settings/settings_mapping.h"

#include <gtest/gtest.h>

#include "tests/error_text.h"

namespace regoplan {
namespace {

double read_radius(const std::string& yaml) {
  return read_mapping(parse_settings(yaml, "f.yaml"), [](SettingsMapping& mapping) {
    mapping.number_or("width_m", kAbove0, 1);
    return mapping.number("radius_m", kAbove0);
  });
}

TEST(SettingsMapping, AKeyThatNobodyAskedForIsAnErrorThatNamesTheNearest) {
  EXPECT_EQ(error_text([] { read_radius("radius_m: 1\nwidht_m: 2\n"); }),
            "f.yaml:2: widht_m: unknown key (did you mean width_m?)");
}

TEST(SettingsMapping, AKeyNearNoneIsAnErrorThatListsAll) {
  EXPECT_EQ(error_text([] { read_radius("radius_m: 1\ncolour: 2\n"); }),
            "f.yaml:2: colour: unknown key (known: radius_m, width_m)");
}

TEST(SettingsMapping, AKeyThatIsGivenIsNotOfferedAgain) {
  EXPECT_EQ(error_text([] { read_radius("radius_m: 1\nwidth_m: 2\nwidht_m: 2\n"); }),
            "f.yaml:3: widht_m: unknown key (known: radius_m, width_m)");
}

TEST(SettingsMapping, AMissingKeyNamesWhatLooksLikeIt) {
  EXPECT_EQ(error_text([] { read_radius("\nradius: 1\n"); }),
            "f.yaml:2: radius_m is missing (radius on line 2: did you mean radius_m?)");
  EXPECT_EQ(error_text([] { read_radius("width_m: 1\n"); }), "f.yaml:1: radius_m is missing");
}

TEST(SettingsMapping, AMissingKeyIsNoMisspellingOfAnotherOfItsFamily) {
  const auto read = [](const std::string& key, const std::string& yaml) {
    return error_text([&] {
      read_mapping(parse_settings(yaml, "f.yaml"),
                   [&](SettingsMapping& mapping) { return mapping.number(key, kAbove0); });
    });
  };
  EXPECT_EQ(read("x_m", "y_m: 1\n"), "f.yaml:1: x_m is missing");
  EXPECT_EQ(read("kx0_m", "kx1_m: 1\n"), "f.yaml:1: kx0_m is missing");
  EXPECT_EQ(read("n", "a0: 1\n"), "f.yaml:1: n is missing");
  EXPECT_EQ(read("goal", "goa: 1\ngaol: 1\n"),
            "f.yaml:1: goal is missing (goa on line 1: did you mean goal?)");
  EXPECT_EQ(read("x_min_m", "x_max_m: 1\n"), "f.yaml:1: x_min_m is missing");
}

TEST(SettingsMapping, AMissingKeyNamesAKeyInWhichOneLetterIsAnother) {
  EXPECT_EQ(error_text([] { read_radius("rasius_m: 1\n"); }),
            "f.yaml:1: radius_m is missing (rasius_m on line 1: did you mean radius_m?)");
  const std::string misspelt = error_text([] {
    read_mapping(parse_settings("gosl: 1\n", "f.yaml"),
                 [](SettingsMapping& mapping) { return mapping.required("goal").number(kAbove0); });
  });
  EXPECT_EQ(misspelt, "f.yaml:1: goal is missing (gosl on line 1: did you mean goal?)");
}

TEST(SettingsMapping, AMissingKeyNamesTheOneThatIsGivenInAnotherUnit) {
  const auto read = [](const std::string& key, const std::string& yaml) {
    return error_text([&] {
      read_mapping(parse_settings(yaml, "f.yaml"),
                   [&](SettingsMapping& mapping) { return mapping.number(key, kAbove0); });
    });
  };
  EXPECT_EQ(read("heading_deg", "\nheading_rad: 1\n"),
            "f.yaml:2: heading_deg is missing (heading_rad on line 2 is in another unit)");
  // One letter off, and yet no slip: whoever renames it has a value that is 1000 times too large.
  EXPECT_EQ(read("mass_kg", "mass_g: 1\n"),
            "f.yaml:1: mass_kg is missing (mass_g on line 1 is in another unit)");
  EXPECT_EQ(read("margin_max", "margin_min: 1\n"), "f.yaml:1: margin_max is missing");
}

TEST(SettingsMapping, SomethingElseThanAMappingIsAnError) {
  EXPECT_NE(error_text([] { read_radius("[1, 2]"); }), "");
  EXPECT_NE(error_text([] { read_radius("5"); }), "");
}

TEST(SettingsMapping, AnAbsentKeyTakesTheFallbackAndAPresentOneIsStillChecked) {
  EXPECT_EQ(read_radius("radius_m: 1\n"), 1);
  EXPECT_EQ(error_text([] { read_radius("radius_m: 1\nwidth_m: 0\n"); }),
            "f.yaml:2: width_m: 0 is not valid (allowed: above 0)");
}

std::string placed_text(const std::string& field) {
  const SettingsNode root =
      parse_settings("vehicle:\n  mass_kg: 5\n  wheels:\n    - {name: left, x_m: 1}\n", "f.yaml");
  return error_text([&] { placed(root, [&]() -> int { throw ValueError(field, 5, "6 to 7"); }); });
}

TEST(SettingsMapping, WhatADomainCheckSaysIsPutWhereTheFieldStands) {
  const std::string says = "5 is not valid (allowed: 6 to 7)";
  EXPECT_EQ(placed_text("mass_kg"), "f.yaml:2: vehicle.mass_kg: " + says);
  EXPECT_EQ(placed_text("vehicle.mass_kg"), "f.yaml:2: vehicle.mass_kg: " + says);
  EXPECT_EQ(placed_text("wheels.left.x_m"),
            "f.yaml:4: vehicle.wheels[0].x_m: wheels.left.x_m: " + says);
}

TEST(SettingsMapping, ADomainCheckOfSomethingTheFileDoesNotGiveNamesTheFieldItself) {
  EXPECT_EQ(placed_text("slip_max"), "f.yaml:1: slip_max: 5 is not valid (allowed: 6 to 7)");
}

TEST(SettingsMapping, ACheckThatBeginsWithAFieldIsPutThereAsWell) {
  const SettingsNode root = parse_settings("a: 1\nstart:\n  x_m: 1\n", "f.yaml");
  const auto text = [&root](const char* what) {
    return error_text([&] { placed(root, [&]() -> int { throw InputError(what); }); });
  };
  EXPECT_EQ(text("start: inside a rock"), "f.yaml:2: start: inside a rock");
  EXPECT_EQ(text("dem.tif: no such file"), "f.yaml:1: dem.tif: no such file");
}

TEST(SettingsMapping, AnErrorThatHasItsPlaceKeepsIt) {
  const SettingsNode root = parse_settings("a: 1\n", "f.yaml");
  EXPECT_EQ(error_text([&] {
              placed(root, []() -> int { throw SettingsError("soils.yaml:7: n: wrong"); });
            }),
            "soils.yaml:7: n: wrong");
}

}  // namespace
}  // namespace regoplan
