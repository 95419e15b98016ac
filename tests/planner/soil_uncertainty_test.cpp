#include "planner/soils/soil_uncertainty.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planner/problem/world.h"
#include "tests/planner/flat_problem.h"

namespace regoplan {
namespace {

UncertainSoil uncertain_regolith() {
  UncertainSoil soil = firm_regolith();
  soil.standard_deviation.cohesion_pa = 50;
  soil.standard_deviation.friction_angle_rad = 2 * kTestDegree;
  soil.standard_deviation.kphi = 2e5;
  soil.standard_deviation.ky0_m = 0.003;
  return soil;
}

/// Turns of 12 m radius at speeds up to 2.5 m/s.
std::vector<VehicleState> turning_states(const World& world) {
  std::vector<VehicleState> states;
  for (int i = 0; i < 10; ++i) {
    states.push_back(world.dynamics().rolling_state(20 + 2 * i, 25, 0, 1.6 + 0.1 * i, 1.0 / 12));
  }
  return states;
}

struct Judged {
  PlanningProblem problem;
  std::vector<VehicleState> states;
  std::vector<PathMargins> at_mean;
};

Judged judged(const UncertainSoil& soil) {
  Judged judged{.problem = lrv_problem(one_soil_map(60, soil, flat)), .states = {}, .at_mean = {}};
  const World world(judged.problem, WorldUse::kVerdict, 1);
  judged.states = turning_states(world);
  judged.at_mean = margins_on(judged.problem, judged.states, {soil.mean});
  return judged;
}

TEST(SoilUncertainty, DrawsDependOnSoilsSeedAndNumberAlone) {
  const PlanningProblem problem = judged(uncertain_regolith()).problem;
  EXPECT_EQ(soil_draw(problem, 7, 3)[0].cohesion_pa, soil_draw(problem, 7, 3)[0].cohesion_pa);
  EXPECT_NE(soil_draw(problem, 7, 3)[0].cohesion_pa, soil_draw(problem, 7, 4)[0].cohesion_pa);
  EXPECT_NE(soil_draw(problem, 7, 3)[0].cohesion_pa, soil_draw(problem, 8, 3)[0].cohesion_pa);
}

TEST(SoilUncertainty, AMarginIsKeptOnlyWithinTheLimitsOfSlipSlipAngleAndSinkage) {
  Judged j = judged(uncertain_regolith());
  const Limits generous = j.problem.limits;
  for (double Limits::*limit :
       {&Limits::slip_max, &Limits::slip_angle_max_rad, &Limits::sinkage_max_m}) {
    // From what the vehicle may to nothing at all: every draw, some, none, and never one more.
    std::vector<int> kept;
    for (double share = 1; share > 1e-3; share *= 0.7) {
      j.problem.limits = generous;
      j.problem.limits.*limit *= share;
      kept.push_back(0);
      for (int draw = 0; draw < 10; ++draw) {
        const SoilDraw soils = soil_draw(j.problem, 3, draw);
        kept.back() += smallest_of(margins_on(j.problem, j.states, soils)).smallest() >= 0;
      }
    }
    EXPECT_EQ(kept.front(), 10);
    EXPECT_EQ(kept.back(), 0);
    EXPECT_TRUE(std::ranges::is_sorted(kept, std::ranges::greater()));
  }
}

TEST(SoilUncertainty, WilsonsIntervalHoldsTheShareAndStaysWithinItsRange) {
  // Newcombe (1998), table I: 81 of 263 gives .2553 to .3662.
  const Probability p = probability_of(81, 263);
  EXPECT_NEAR(p.low, 0.2553, 5e-5);
  EXPECT_NEAR(p.high, 0.3662, 5e-5);
  EXPECT_EQ(probability_of(0, 20).low, 0);
  EXPECT_GT(probability_of(0, 20).high, 0);
  EXPECT_EQ(probability_of(20, 20).high, 1);
  EXPECT_LT(probability_of(20, 20).low, 1);
}

TEST(SoilUncertainty, KnownSoilsLeaveNothingToChance) {
  const Judged j = judged(firm_regolith());
  const SoilSpread spread =
      soil_spread(j.problem, j.states, j.at_mean, {.draws = 50, .threads = 1});
  EXPECT_EQ(spread.draws, 0);
  EXPECT_EQ(spread.margin.p05, spread.margin.p95);
  EXPECT_TRUE(spread.influences.empty());
}

TEST(SoilUncertainty, TheSurrogateIsOnTheSafeSideOfTheWheelModel) {
  constexpr int kDraws = 260;
  const Judged j = judged(uncertain_regolith());
  const SoilSpread spread =
      soil_spread(j.problem, j.states, j.at_mean, {.draws = kDraws, .threads = 2});
  ASSERT_LT(spread.direct_draws, spread.draws);
  std::vector<double> direct;
  for (int i = 0; i < kDraws; ++i) {
    double smallest = 1;
    for (const PathMargins& one : margins_on(j.problem, j.states, soil_draw(j.problem, 1, i))) {
      smallest = std::min(smallest, one.smallest());
    }
    direct.push_back(smallest);
  }
  const Quantiles exact = quantiles_of(direct);
  EXPECT_LE(spread.margin.p05, exact.p05 + 1e-3);
  EXPECT_LE(spread.margin.p50, exact.p50 + 1e-3);
  EXPECT_NEAR(spread.margin.p05, exact.p05, 0.02);
  EXPECT_NEAR(spread.margin.p50, exact.p50, 0.02);
}

/// Across a slope on which the side force ends far before traction does.
Judged six_wheels_across_a_slope() {
  UncertainSoil sand{.mean = {.cohesion_pa = 500,
                              .friction_angle_rad = 33 * kTestDegree,
                              .kc = 2000,
                              .kphi = 1.2e6,
                              .n = 1.05,
                              .a0 = 0.4,
                              .a1 = 0.15,
                              .lambda = 0.9,
                              .density_kgpm3 = 1550,
                              .kx0_m = 0.02,
                              .ky0_m = 0.015,
                              .ky1_m = 0.02}};
  sand.standard_deviation.cohesion_pa = 150;
  sand.standard_deviation.friction_angle_rad = 2 * kTestDegree;
  const auto across = [](double /*x_m*/, double y_m) { return y_m * std::tan(23 * kTestDegree); };
  Judged judged{
      .problem = lrv_problem(one_soil_map(60, sand, across)), .states = {}, .at_mean = {}};
  PlanningProblem& problem = judged.problem;
  problem.gravity_mps2 = 9.81;
  Vehicle& vehicle = problem.vehicle;
  vehicle.mass_kg = 300;
  vehicle.yaw_inertia_kgm2 = 150;
  vehicle.cg_height_m = 0.5;
  vehicle.wheel = {.radius_m = 0.2, .width_m = 0.2};
  vehicle.wheels.clear();
  for (const double x_m : {0.9, 0.0, -0.9}) {
    for (const double y_m : {0.7, -0.7}) {
      vehicle.wheels.push_back(
          {.name = fmt::format("{} {}", x_m, y_m), .x_m = x_m, .y_m = y_m, .steered = x_m != 0});
    }
  }
  vehicle.turn_centre_x_m = 0;
  vehicle.curvature_max_1pm = 0.5;
  vehicle.steer_angle_max_rad = 50 * kTestDegree;
  vehicle.slip_angle_max_rad = 16 * kTestDegree;
  vehicle.sinkage_max_m = 0.07;
  problem.limits = default_limits(vehicle);
  const World world(problem, WorldUse::kVerdict, 1);
  for (int i = 0; i < 3; ++i) {
    judged.states.push_back(world.dynamics().rolling_state(20 + 5 * i, 25, 0, 0.1));
  }
  judged.at_mean = margins_on(problem, judged.states, {sand.mean});
  return judged;
}

TEST(SoilUncertainty, WhatTheSurrogateSaysOfAMarginThatIsNeverTheSmallestCostsNoDraws) {
  constexpr int kDraws = 300;
  const Judged j = six_wheels_across_a_slope();
  for (const std::uint64_t seed : {1, 2}) {
    const SoilSpread spread =
        soil_spread(j.problem, j.states, j.at_mean, {.draws = kDraws, .seed = seed, .threads = 2});
    ASSERT_GT(spread.traction.p05, spread.cornering.p95);
    EXPECT_EQ(spread.draws, kDraws) << "seed " << seed;
    EXPECT_LT(spread.direct_draws, kDraws) << "seed " << seed;
    std::vector<double> smallest, traction;
    for (int i = 0; i < kDraws; ++i) {
      const PathMargins direct =
          smallest_of(margins_on(j.problem, j.states, soil_draw(j.problem, seed, i)));
      smallest.push_back(direct.smallest());
      if (i < spread.direct_draws) traction.push_back(direct.traction);
    }
    EXPECT_NEAR(spread.margin.p05, quantiles_of(smallest).p05, 1e-3);
    EXPECT_NEAR(spread.traction.p05, quantiles_of(traction).p05, 1e-3);
  }
}

TEST(SoilUncertainty, AnUncertainSoilCountsThoughAKnownOneBindsAtTheMeans) {
  // West of x = 30 regolith that may be far weaker than its mean, east of it a known, weaker one.
  UncertainSoil west = firm_regolith(), east = firm_regolith();
  west.standard_deviation.friction_angle_rad = 6 * kTestDegree;
  east.mean.friction_angle_rad -= 3 * kTestDegree;
  const TerrainMap ground = one_soil_map(60, west, flat);
  ClassRaster classes{.frame = ground.elevation().frame, .code = {}};
  for (int i = 0; i < 120 * 120; ++i) classes.code.push_back(i % 120 < 60 ? 1 : 2);
  const PlanningProblem problem =
      lrv_problem({ground.elevation(),
                   classes,
                   SoilCatalogue{.soils = {{"west", "test", west}, {"east", "test", east}},
                                 .classes = {{1, 0}, {2, 1}},
                                 .unmapped = {}},
                   {}});
  const World world(problem, WorldUse::kVerdict, 1);
  std::vector<VehicleState> states;
  for (int i = 0; i < 16; ++i) {
    states.push_back(world.dynamics().rolling_state(12 + 2.5 * i, 25, 0, 2.5, 1.0 / 12));
  }
  const std::vector<PathMargins> at_mean = margins_on(problem, states, {west.mean, east.mean});
  constexpr int kDraws = 40;
  const SoilSpread spread = soil_spread(problem, states, at_mean, {.draws = kDraws, .threads = 2});
  std::vector<double> everywhere;
  for (int i = 0; i < kDraws; ++i) {
    everywhere.push_back(
        smallest_of(margins_on(problem, states, soil_draw(problem, 1, i))).smallest());
  }
  const Quantiles exact = quantiles_of(everywhere);
  ASSERT_LT(exact.p05, smallest_of(at_mean).smallest() - 0.02);
  EXPECT_EQ(spread.draws, kDraws);
  EXPECT_NEAR(spread.margin.p05, exact.p05, 1e-3);
  EXPECT_EQ(spread.margin.p95, exact.p95);  // of the known soil
}

TEST(SoilUncertainty, QuantilesRiseAndTheProbabilityLiesInItsInterval) {
  const Judged j = judged(uncertain_regolith());
  const SoilSpread spread =
      soil_spread(j.problem, j.states, j.at_mean, {.draws = 60, .threads = 2});
  for (const Quantiles& q : {spread.cornering, spread.tip_over, spread.traction, spread.margin}) {
    EXPECT_LE(q.p05, q.p50);
    EXPECT_LE(q.p50, q.p95);
  }
  EXPECT_LE(spread.margin.p05, spread.cornering.p05);
  EXPECT_LE(spread.feasible.low, spread.feasible.share);
  EXPECT_GE(spread.feasible.high, spread.feasible.share);
}

TEST(SoilUncertainty, TheNumberThatAloneIsUncertainDecidesAlone) {
  UncertainSoil soil = firm_regolith();
  soil.standard_deviation.friction_angle_rad = 2 * kTestDegree;
  const Judged j = judged(soil);
  const SoilSpread spread =
      soil_spread(j.problem, j.states, j.at_mean, {.draws = 40, .threads = 2});
  ASSERT_EQ(spread.influences.size(), 1);
  EXPECT_EQ(spread.influences[0].parameter, "friction_angle_deg");
  EXPECT_GT(spread.influences[0].share, 0.95);
  EXPECT_GT(spread.influences[0].margin_per_std, 0);  // stronger soil holds better
}

TEST(SoilUncertainty, AFewDrawsDoNotTellWhatDecides) {
  const Judged j = judged(uncertain_regolith());  // four uncertain numbers
  EXPECT_TRUE(
      soil_spread(j.problem, j.states, j.at_mean, {.draws = 11, .threads = 2}).influences.empty());
  EXPECT_EQ(
      soil_spread(j.problem, j.states, j.at_mean, {.draws = 12, .threads = 2}).influences.size(),
      4);
}

}  // namespace
}  // namespace regoplan
