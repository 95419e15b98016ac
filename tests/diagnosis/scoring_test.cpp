// Candidates and how they are weighed against each other.
#include "diagnosis/fit/scoring.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "account_of.h"
#include "calibrated_bed.h"
#include "diagnosis/fit/effect_list.h"

namespace regoplan {
namespace {

std::vector<ScoredId> scored(const std::vector<std::pair<std::string, double>>& scores) {
  std::vector<ScoredId> all;
  for (const auto& [id, score] : scores) all.push_back({.account = account_of(id), .score = score});
  return all;
}

double probability(const std::vector<ScoredId>& all, const std::string& id) {
  const auto found = std::ranges::find(all, id, &ScoredId::id);
  return found == all.end() ? 0 : found->probability;
}

TEST(Weighing, ProbabilitiesAddUpAndTheLikeliestStandsFirst) {
  auto all = scored({{"none", -40}, {"parameters", -30}, {"grousers", -10}, {"multi_pass", -12}});
  weigh(all, PlainModel::kRefuted);
  double sum = 0;
  for (const ScoredId& one : all) sum += one.probability;
  EXPECT_NEAR(sum, 1, 1e-12);
  EXPECT_EQ(all.front().id(), "grousers");
  EXPECT_TRUE(std::ranges::is_sorted(all, std::greater{}, &ScoredId::probability));
}

TEST(Weighing, WhatTestsRefuteOrHeldOutConditionsForbidHasNoProbability) {
  auto all = scored({{"none", -1}, {"parameters", 0}, {"grousers", -10}, {"multi_pass", -9}});
  all[3].given_up = true;
  weigh(all, PlainModel::kRefuted);
  EXPECT_EQ(probability(all, "none"), 0);
  EXPECT_EQ(probability(all, "parameters"), 0);
  EXPECT_EQ(probability(all, "multi_pass"), 0);
  EXPECT_EQ(probability(all, "grousers"), 1);
}

TEST(Weighing, AModelThatHoldsIsNotGivenUpForANameThatFitsALittleBetter) {
  auto holds = scored({{"parameters", 0}, {"grousers", 8}});
  weigh(holds, PlainModel::kHolds);
  EXPECT_GT(probability(holds, "parameters"), 0.9);
  auto doubted = scored({{"parameters", 0}, {"grousers", 8}});
  weigh(doubted, PlainModel::kDoubted);
  EXPECT_GT(probability(doubted, "grousers"), 0.9);
}

TEST(Weighing, TwoEffectsMustFitBetterThanOne) {
  auto all = scored({{"parameters", 0}, {"grousers", 50}, {"grousers+multi_pass", 51}});
  weigh(all, PlainModel::kRefuted);
  EXPECT_GT(probability(all, "grousers"), probability(all, "grousers+multi_pass"));
}

TEST(Weighing, ASoilAsItsTestsSayIsNoMeritOverANameFittedWithTheSoilFree) {
  auto all = scored({{"none", 6}, {"parameters", 0}, {"sensor_bias", 10}});
  weigh(all, PlainModel::kDoubted);
  EXPECT_GT(probability(all, "sensor_bias"), 0.9);
  EXPECT_GT(probability(all, "none"), 100 * probability(all, "parameters"));
}

/// A recording of a wheel that sinks deeper as it slips.
Recording of_a_wheel_that_digs(const DiagnosisSetup& setup) {
  TrueWheel digging;
  digging.sinkage = [](const WheelRun& run, double h) {
    return h * (1 + 1.2 * std::max(run.slip_ratio, 0.0));
  };
  return record(digging, setup, setup.soil.mean, {.conditions = 24}, 3);
}

TEST(Scoring, TheEffectAtWorkScoresBestAndThePlainModelsStandBeside) {
  const DiagnosisSetup setup = simulant_setup();
  const Recording recording = of_a_wheel_that_digs(setup);
  const CalibratedBed bed(recording);
  std::vector<Effect> effects = effects_for(bed.recording.bed, recording);
  std::erase_if(effects, [](const Effect& e) {
    return e.id != "slip_sinkage" && e.id != "grousers" && e.id != "rear_contact";
  });
  const FitProblem problem = bed.problem();
  const std::vector<SoilCoordinate> wide_soil = soil_coordinates(setup.soil, 3);
  const FitProblem wide{bed.recording.bed, wide_soil, bed.discrepancy, bed.soil_free};
  const std::vector<ScoredId> all = score_candidates(problem, wide, effects, {});
  for (const char* id : {"none", "parameters", "unexplained", "slip_sinkage", "grousers"}) {
    EXPECT_EQ(std::ranges::count(all, id, &ScoredId::id), 1) << id;
  }
  const auto best_single = std::ranges::max_element(all, {}, [](const ScoredId& one) {
    return one.account.effects.size() < 2 ? one.score : -INFINITY;
  });
  EXPECT_EQ(best_single->id(), "slip_sinkage");
  for (const ScoredId& one : all) {
    const std::vector<Effect>& of = one.fit.candidate.effects;
    if (of.size() < 2) continue;
    EXPECT_NE(of[0].id, of[1].id) << "an effect beside itself";
  }
}

TEST(Scoring, AMechanismWhoseFormulasMakeMoreOfOneChannelIsStillLikely) {
  // Two formulas of one mechanism, the second with a quarter more of torque: as far as it is from
  // the first in many deviations of the noise, the name is to lose little.
  const Recording recording = of_a_wheel_that_digs(simulant_setup());
  CalibratedBed bed(recording);
  const std::vector<Effect> effects = effects_for(bed.recording.bed, recording);
  const auto sinkage = std::ranges::find(effects, "slip_sinkage", &Effect::id);
  ASSERT_NE(sinkage, effects.end());
  const auto fitted = [&] {
    const FitProblem problem = bed.problem();
    return *fit_candidate(problem, {{*sinkage}}, SettingWeights::of_named(),
                          start_of(problem, {{*sinkage}}));
  };
  const CandidateFit alike = fitted();
  const Eigen::VectorXd part = *part_of(bed.recording.bed, bed.soil, alike, 0);
  double deviations = 0;
  for (std::size_t c = 0; c < bed.recording.bed.channels.size(); ++c) {
    ChannelData& data = bed.recording.bed.channels[c];
    if (data.channel != Channel::kTorque) continue;
    const Eigen::VectorXd more = 0.25 * part.segment(bed.recording.bed.offset(c), data.mean.size());
    deviations = std::sqrt(more.dot(data.noise.llt().solve(more)));
    data.mean += more;
  }
  const CandidateFit other = fitted();
  EXPECT_GT(deviations, 8);
  EXPECT_LT(alike.evidence.log_marginal - other.evidence.log_marginal, 1.8);
}

TEST(Scoring, AZoneHasItsEdgesWhereTheyAreAndNotAtAnEighthOfTheBed) {
  constexpr double kFrom_m = 0.31, kTo_m = 0.69;
  TrueWheel patch;
  patch.stiffness = [](const WheelRun& run) {
    const double at_m = run.conditions.position_m;
    return at_m > kFrom_m && at_m < kTo_m ? 0.5 : 1.0;
  };
  const DiagnosisSetup setup = simulant_setup();
  const BedPlan plan{.positions = true};
  const Recording recording = record(patch, setup, setup.soil.mean, plan, 5);
  const CalibratedBed bed(recording);
  std::vector<Effect> effects = effects_for(bed.recording.bed, recording);
  std::erase_if(effects, [](const Effect& e) { return e.id != "soil_zone"; });
  const std::vector<SoilCoordinate> wide_soil = soil_coordinates(setup.soil, 3);
  const FitProblem wide{bed.recording.bed, wide_soil, bed.discrepancy, bed.soil_free};
  const std::vector<ScoredId> all = score_candidates(bed.problem(), wide, effects, {});
  const auto zone = std::ranges::find(all, "soil_zone", &ScoredId::id);
  ASSERT_NE(zone, all.end());
  const auto& edges = zone->fit.candidate.effects.front().fixed;
  const double between_conditions_m = 1.0 / static_cast<double>(plan.conditions);
  EXPECT_NEAR(edges.at("from_m"), kFrom_m, between_conditions_m);
  EXPECT_NEAR(edges.at("to_m"), kTo_m, between_conditions_m);
}

}  // namespace
}  // namespace regoplan
