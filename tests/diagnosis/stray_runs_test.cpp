#include "diagnosis/checks/stray_runs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "calibrated_bed.h"

namespace regoplan {
namespace {

DiagnosisSetup told_noise() {
  DiagnosisSetup setup = simulant_setup();
  setup.noise_standard_deviation = {
      {Channel::kFx, 1}, {Channel::kFy, 1}, {Channel::kTorque, 0.09}, {Channel::kSinkage, 5e-4}};
  return setup;
}

CondensedRecording weighed_down(const Recording& recording, const DiagnosisSetup& setup) {
  const CalibratedBed bed(recording, setup);
  return strays_weighed_down(recording, bed.recording, bed.fit.prediction);
}

TEST(StrayRuns, AnOutlierThatNoReplicateTellsIsWeighedDown) {
  const DiagnosisSetup setup = told_noise();
  Recording recording =
      record({}, setup, setup.soil.mean, {.replicates = 1, .day = 0, .outliers = 0}, 1);
  recording.runs[17].measured[0] += 8;
  const CondensedRecording found = weighed_down(recording, setup);
  EXPECT_EQ(found.noise[0].outliers, std::vector<std::size_t>{17});
  EXPECT_LT(found.noise[0].weight[17], 0.5);
  EXPECT_NE(found.notes.back().find(recording.runs[17].run_id), std::string::npos);
}

TEST(StrayRuns, TwoFarOutliersDoNotHideEachOther) {
  // A rough surface that turns up to one and down to the other would take both for its own.
  const DiagnosisSetup setup = told_noise();
  const Recording plain =
      record({}, setup, setup.soil.mean, {.replicates = 1, .day = 0, .outliers = 0}, 1);
  for (std::size_t other = 18; other < 34; ++other) {
    Recording recording = plain;
    recording.runs[17].measured[1] += 9;
    recording.runs[other].measured[1] -= 6;
    std::vector<std::size_t> outliers = weighed_down(recording, setup).noise[1].outliers;
    std::ranges::sort(outliers);
    EXPECT_EQ(outliers, (std::vector<std::size_t>{17, other}));
  }
}

TEST(StrayRuns, AMismatchThatNeighboursShareIsNoStray) {
  const DiagnosisSetup setup = told_noise();
  TrueWheel wheel;
  wheel.fx_n = [](const WheelRun& run, double) { return -12 * std::max(run.slip_ratio, 0.0); };
  const Recording recording =
      record(wheel, setup, setup.soil.mean, {.replicates = 1, .day = 0, .outliers = 0}, 2);
  for (const ChannelNoise& noise : weighed_down(recording, setup).noise) {
    EXPECT_TRUE(noise.outliers.empty()) << name(noise.channel);
  }
}

TEST(StrayRuns, ThreeReplicatesSpeakForThemselves) {
  const DiagnosisSetup setup = told_noise();
  const Recording recording = record({}, setup, setup.soil.mean, {}, 3);
  const CalibratedBed bed(recording, setup);
  const CondensedRecording found =
      strays_weighed_down(recording, bed.recording, bed.fit.prediction);
  for (std::size_t c = 0; c < found.noise.size(); ++c) {
    EXPECT_EQ(found.noise[c].weight, bed.recording.noise[c].weight);
  }
}

TEST(StrayRuns, TwoStraysOfThreeAreNoMajority) {
  const DiagnosisSetup setup = told_noise();
  Recording recording = record({}, setup, setup.soil.mean, {.day = 0, .outliers = 0}, 4);
  const CondensedRecording plain = condense(recording, setup);
  const std::vector<std::size_t> runs = plain.bed.conditions[plain.condition[17]].runs;
  ASSERT_EQ(runs.size(), 3);
  recording.runs[runs[1]].measured[0] += 9;
  recording.runs[runs[2]].measured[0] += 8;
  const std::vector<double> weight = weighed_down(recording, setup).noise[0].weight;
  EXPECT_EQ(weight[runs[0]], 1);
  EXPECT_LT(weight[runs[1]], 0.1);
  EXPECT_LT(weight[runs[2]], 0.1);
}

/// What is made of three runs of a condition that lie so many standard deviations from the model,
/// where the replicates' weights are told.
std::vector<double> weights_of_three(const std::array<double, 3>& deviations,
                                     const std::array<double, 3>& weights) {
  const DiagnosisSetup setup = told_noise();
  const Recording recording = record({}, setup, setup.soil.mean, {.day = 0, .outliers = 0}, 4);
  CondensedRecording condensed = condense(recording, setup);
  const CalibratedBed bed(recording, setup);
  const std::size_t at = condensed.condition[17];
  const std::vector<std::size_t> runs = condensed.bed.conditions[at].runs;
  const auto& conditions = condensed.bed.channels[0].conditions;
  const auto place = std::ranges::find(conditions, at) - conditions.begin();
  const double model = bed.fit.prediction[place];
  const double scatter = run_deviation(condensed.noise[0], model);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    condensed.adjusted[0][runs[i]] = model + deviations.at(i) * scatter;
    condensed.noise[0].weight[runs[i]] = weights.at(i);
  }
  condensed.bed.channels[0] =
      means_of(condensed.day, condensed.bed.conditions, condensed.noise[0], condensed.adjusted[0]);
  const CondensedRecording found = strays_weighed_down(recording, condensed, bed.fit.prediction);
  std::vector<double> result;
  for (const std::size_t run : runs) result.push_back(found.noise[0].weight[run]);
  return result;
}

TEST(StrayRuns, ARunThatTwoHaveOutvotedIsRightWhereNeighboursAgreeWithIt) {
  // Nearer to each other than what is at odds by itself.
  const std::vector<double> weight = weights_of_three({0.2, 5.4, 5.6}, {0.1, 1, 1});
  EXPECT_EQ(weight[0], 1);
  EXPECT_LT(weight[1], 0.1);
  EXPECT_LT(weight[2], 0.1);
}

TEST(StrayRuns, AStrayStaysOneWhereNeighboursLieBetweenItAndItsFellows) {
  const std::vector<double> weight = weights_of_three({-2.7, -2.6, 2}, {1, 1, 0.1});
  EXPECT_EQ(weight, (std::vector<double>{1, 1, 0.1}));
}

}  // namespace
}  // namespace regoplan
