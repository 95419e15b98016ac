#include "planner/verdict/ranking.h"

#include <gtest/gtest.h>

namespace regoplan {
namespace {

/// A straight path, so far aside of the x axis.
VerifiedPath path(const char* name, double margin_min, double duration_s, double aside_m = 0) {
  VerifiedPath made;
  made.candidate.planner = name;
  made.candidate.margin_min = margin_min;
  made.candidate.duration_s = duration_s;
  made.candidate.length_m = 40;
  for (double x = 0; x <= 40; x += 10) {
    made.candidate.points.push_back({.x_m = x, .y_m = aside_m});
  }
  return made;
}

VerifiedPath drawn(VerifiedPath path, double p05, double p05_high,
                   Probability feasible = {1, 1, 1}) {
  path.candidate.spread =
      MarginSpread{.draws = 100, .p05 = p05, .p05_high = p05_high, .feasible = feasible};
  return path;
}

VerifiedPath off(VerifiedPath path) {
  path.candidate.off_doubtful_soils = true;
  return path;
}

std::string order_of(std::vector<VerifiedPath> paths) {
  rank(paths);
  std::string names;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    EXPECT_EQ(paths[i].candidate.rank, static_cast<int>(i) + 1);
    names += paths[i].candidate.planner;
  }
  return names;
}

TEST(Ranking, GoesByTheQuantileOverTheDrawsNotByTheMarginAtTheMeanSoils) {
  EXPECT_EQ(
      order_of({drawn(path("a", 0.30, 50), 0.05, 0.06), drawn(path("b", 0.20, 50), 0.10, 0.11)}),
      "ba");
}

TEST(Ranking, WhoLiesWithinItsOwnSamplingErrorOfTheBestIsTiedAndTimeDecides) {
  const VerifiedPath best = drawn(path("a", 0.2, 90), 0.103, 0.12);
  EXPECT_EQ(order_of({best, drawn(path("b", 0.2, 60), 0.100, 0.11)}), "ba");
  EXPECT_EQ(order_of({best, drawn(path("b", 0.2, 60), 0.100, 0.102)}), "ab");
}

TEST(Ranking, TiedRanksAreThoseThatTheDrawsCannotTellApart) {
  std::vector<VerifiedPath> paths{
      drawn(path("a", 0.2, 90), 0.103, 0.12), drawn(path("b", 0.2, 60), 0.100, 0.11),
      drawn(path("c", 0.2, 50), 0.050, 0.06), drawn(path("d", 0.2, 40), 0.020, 0.03),
      drawn(path("e", 0.2, 30), 0.015, 0.021)};
  rank(paths);
  std::vector<Candidate> ranked;
  for (const VerifiedPath& path : paths) ranked.push_back(path.candidate);
  EXPECT_EQ(tied_ranks(ranked), (std::vector<std::pair<int, int>>{{1, 2}, {4, 5}}));
  EXPECT_TRUE(tied_ranks({ranked[0], ranked[2]}).empty());
}

TEST(Ranking, ABinsEdgeDecidesNothing) {
  // A thousandth apart, on either side of what would be a bin's edge of a hundredth.
  for (const double p05 : {0.1045, 0.1055, 0.1095}) {
    EXPECT_EQ(order_of({drawn(path("a", 0.2, 90), p05 + 0.001, 0.2),
                        drawn(path("b", 0.2, 60), p05, 0.2)}),
              "ba");
  }
}

TEST(Ranking, GroupsAreFormedFromTheBestDown) {
  // c reaches b, which reaches a; c does not reach a, which leads.
  EXPECT_EQ(order_of({drawn(path("c", 0.2, 10), 0.06, 0.09), drawn(path("b", 0.2, 20), 0.08, 0.11),
                      drawn(path("a", 0.2, 30), 0.10, 0.12)}),
            "bac");
}

TEST(Ranking, AmongEquallyFastPathsTheShorterIsFirst) {
  VerifiedPath longer = drawn(path("a", 0.2, 60), 0.1, 0.12);
  longer.candidate.length_m = 250;
  EXPECT_EQ(order_of({longer, drawn(path("b", 0.2, 60), 0.1, 0.12)}), "ba");
}

TEST(Ranking, WhereLimitsBreakTheShareOfDrawsThatHoldRanksFirst) {
  const double broken = MarginSpread::kBroken;
  const VerifiedPath seldom = drawn(path("a", 0.3, 10), broken, 0.1, {0.58, 0.48, 0.67});
  const VerifiedPath mostly = drawn(path("b", 0.1, 90), broken, 0.1, {0.90, 0.83, 0.94});
  const VerifiedPath holds = drawn(path("c", 0.1, 99), 0.01, 0.02);
  EXPECT_EQ(order_of({seldom, mostly, holds}), "cba");
}

TEST(Ranking, WhereDrawsCannotTellWhichBreaksLimitsSeldomerPathsOffDoubtfulSoilsRankFirst) {
  const double broken = MarginSpread::kBroken;
  const VerifiedPath across = drawn(path("a", 0.3, 70), broken, 0.1, {0.70, 0.40, 0.89});
  const VerifiedPath round = off(drawn(path("b", 0.2, 79), broken, 0.1, {0.75, 0.53, 0.89}));
  EXPECT_EQ(order_of({across, round}), "ba");
  const VerifiedPath surely = drawn(path("c", 0.3, 70), broken, 0.1, {0.94, 0.90, 0.97});
  EXPECT_EQ(order_of({round, surely}), "cb");
  // Within limits in all but 5 % of draws, the faster of two that are tied does it.
  EXPECT_EQ(
      order_of({off(drawn(path("d", 0.2, 79), 0.10, 0.12)), drawn(path("e", 0.2, 70), 0.10, 0.12)}),
      "ed");
}

TEST(Ranking, WhatWasNotDrawnComesLastByItsMarginAtTheMeanSoils) {
  EXPECT_EQ(order_of({path("a", 0.2, 10), path("b", 0.3, 20), drawn(path("c", 0.1, 99), 0, 0.01)}),
            "cba");
}

TEST(DifferentPaths, KeepTheWidestThenTheFastestAndNoneTwice) {
  const std::vector<VerifiedPath> chosen = different_paths(
      {path("slow", 0.25, 90, 10), path("fast", 0.08, 50, 20), path("twin", 0.29, 60, 0.5),
       path("widest", 0.30, 80, 0), path("fourth", 0.20, 70, 30)},
      preset_vehicle("lrv"), 3);
  std::string names;
  for (const VerifiedPath& one : chosen) names += one.candidate.planner + " ";
  EXPECT_EQ(names, "widest fast slow ");
}

TEST(DifferentPaths, WhereSoilsAreDoubtfulTwoOfThoseSearchedOffThemComeFirst) {
  const std::vector<VerifiedPath> chosen = different_paths(
      {path("fast", 0.08, 50, 10), path("widest", 0.30, 80, 20), off(path("w-slow", 0.05, 99, 30)),
       off(path("w-fast", 0.04, 90, 40)), off(path("w-wide", 0.06, 95, 50))},
      preset_vehicle("lrv"), 4);
  std::string names;
  for (const VerifiedPath& one : chosen) names += one.candidate.planner + " ";
  EXPECT_EQ(names, "w-wide w-fast widest fast ");
}

TEST(DifferentPaths, APathThatMakesADetourDiffersFromTheOneThatItOtherwiseFollows) {
  // Every point of the straight path lies on the other one, which strays by 10 m on its way.
  VerifiedPath detour = path("detour", 0.2, 70);
  detour.candidate.points.insert(detour.candidate.points.begin() + 2, {.x_m = 15, .y_m = 10});
  for (const auto& paths : {std::vector{path("straight", 0.3, 50), detour},
                            std::vector{detour, path("straight", 0.1, 50)}}) {
    EXPECT_EQ(different_paths(paths, preset_vehicle("lrv"), 2).size(), 2);
  }
}

TEST(DifferentPaths, DifferByTheWidthOfASmallVehicle) {
  const auto count = [](const char* vehicle, double apart_m) {
    std::vector<VerifiedPath> paths{path("widest", 0.3, 80), path("fastest", 0.1, 75, apart_m)};
    for (VerifiedPath& path : paths) path.candidate.length_m = 4;
    return different_paths(paths, preset_vehicle(vehicle), 5).size();
  };
  EXPECT_EQ(count("tohoku", 0.6), 2);
  EXPECT_EQ(count("tohoku", 0.4), 1);
  for (const char* large : {"lrv", "curiosity"}) {
    EXPECT_EQ(count(large, 1.9), 1) << large;
    EXPECT_EQ(count(large, 2.1), 2) << large;
  }
}

TEST(DifferentPaths, TheFastestStaysBesideTheWidestOfTheSameWayWhereItIsClearlyFaster) {
  const auto count = [](double duration_s) {
    return different_paths({path("widest", 0.43, 100), path("fastest", 0.42, duration_s, 0.1)},
                           preset_vehicle("lrv"), 5)
        .size();
  };
  EXPECT_EQ(count(95), 1);
  EXPECT_EQ(count(75), 2);
}

TEST(Doubt, GoesByTheShareOfDrawsAgainstWhatIsCountedOn) {
  const auto with = [](const Probability& feasible) {
    return drawn(path("a", 0.2, 50), 0.1, 0.11, feasible).candidate;
  };
  // 96 of 100 hold: more than are counted on, though the interval's lower end is not.
  EXPECT_FALSE(is_doubtful(with({.share = 0.96, .low = 0.90, .high = 0.98}), {}));
  EXPECT_TRUE(is_doubtful(with({.share = 0.94, .low = 0.88, .high = 0.97}), {}));
  EXPECT_TRUE(
      is_doubtful(with({.share = 0.96, .low = 0.90, .high = 0.98}), {.probability_min = 0.97}));
  EXPECT_FALSE(is_doubtful(path("a", 0.2, 50).candidate, {}));  // nothing was drawn
}

TEST(ChanceConstraint, IsHeldAgainstTheLowerEndOfTheInterval) {
  const Limits limits{.probability_min = 0.9};
  const auto with = [](const Probability& feasible) {
    return drawn(path("a", 0.2, 50), 0.1, 0.11, feasible).candidate;
  };
  EXPECT_FALSE(probable_enough(with({.share = 0.96, .low = 0.89, .high = 0.99}), limits));
  EXPECT_TRUE(probable_enough(with({.share = 0.96, .low = 0.91, .high = 0.99}), limits));
}

TEST(ChanceConstraint, WhatWasNotDrawnKeepsNone) {
  const Candidate undrawn = path("a", 0.2, 50).candidate;
  EXPECT_FALSE(probable_enough(undrawn, {.probability_min = 0.01}));
  EXPECT_TRUE(probable_enough(undrawn, {.probability_min = 0}));
}

}  // namespace
}  // namespace regoplan
