#include "diagnosis/recording/noise_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "terramech/basics/input_error.h"

namespace regoplan {
namespace {

struct Bed {
  Recording recording;
  std::vector<Condition> conditions;
  std::vector<double> value;
};

/// Conditions of growing signal, one run of each on every day.
Bed bed(int conditions, int days, double noise, double proportional, double day_deviation,
        std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Bed made;
  std::vector<double> of_day;
  for (int d = 0; d < days; ++d) of_day.push_back(day_deviation * normal(random));
  made.conditions.resize(static_cast<std::size_t>(conditions));
  for (int k = 0; k < conditions; ++k) {
    for (int d = 0; d < days; ++d) {
      const double signal = 0.5 * k;
      const double y = signal + std::hypot(noise, proportional * signal) * normal(random) +
                       of_day[static_cast<std::size_t>(d)];
      made.conditions[static_cast<std::size_t>(k)].runs.push_back(made.recording.runs.size());
      WheelRun run{.load_n = 60, .day = static_cast<double>(d)};
      run.measured[0] = y;
      made.recording.runs.push_back(run);
      made.value.push_back(y);
    }
  }
  return made;
}

ChannelNoise noise_of(const Bed& made, const DiagnosisSetup& setup = {}) {
  return estimate_noise(made.recording, made.conditions,
                        {Channel::kFx, made.value, std::vector<double>(made.value.size(), 0.0)},
                        setup);
}

TEST(NoiseModel, FindsTheScatterOfReplicates) {
  const ChannelNoise noise = noise_of(bed(50, 3, 0.8, 0, 0, 1));
  EXPECT_EQ(noise.source, NoiseSource::kReplicates);
  EXPECT_EQ(noise.degrees_of_freedom, 100);
  EXPECT_NEAR(run_deviation(noise, 5), 0.8, 0.15);
  EXPECT_LT(noise.day_offset, 0.3);
}

TEST(NoiseModel, SeesNoiseThatGrowsWithTheSignal) {
  const ChannelNoise noise = noise_of(bed(60, 3, 0.2, 0.1, 0, 2));
  EXPECT_GT(run_deviation(noise, 25), 3 * run_deviation(noise, 0));
}

TEST(NoiseModel, TellsDaysFromScatter) {
  const ChannelNoise noise = noise_of(bed(40, 6, 0.5, 0, 1.5, 3));
  EXPECT_NEAR(noise.constant, 0.5, 0.1);
  EXPECT_GT(noise.day_offset, 0.5);
}

TEST(NoiseModel, WhatDaysDoToOtherChannelsIsHeldPossibleForAChannelThatDoesNotShowIt) {
  std::vector<ChannelNoise> noise{{.constant = 2, .day_offset = 0},
                                  {.constant = 0.1, .day_offset = 0.1},
                                  {.constant = 5, .day_offset = 5}};
  share_day_offsets(noise, 3);
  EXPECT_NEAR(noise[0].day_offset, 2 * std::sqrt(1.0 / 3), 1e-12);
  EXPECT_NEAR(noise[1].day_offset, 0.1 * std::sqrt(5.0 / 6), 1e-12);

  std::vector<ChannelNoise> many = noise;
  share_day_offsets(many, 1000);  // then every channel speaks for itself
  for (std::size_t c = 0; c < noise.size(); ++c) {
    EXPECT_NEAR(many[c].day_offset, noise[c].day_offset, 0.01 * noise[c].constant);
  }
}

TEST(NoiseModel, AnOutlierIsNamedAndDoesNotSpoilTheScatter) {
  Bed made = bed(40, 3, 0.5, 0, 0, 4);
  made.value[31] += 8;
  const ChannelNoise noise = noise_of(made);
  EXPECT_EQ(noise.outliers, std::vector<std::size_t>{31});
  EXPECT_NEAR(noise.constant, 0.5, 0.12);
}

TEST(NoiseModel, WithoutReplicatesTheSetupsNumberCounts) {
  DiagnosisSetup setup;
  setup.noise_standard_deviation[Channel::kFx] = 0.7;
  const ChannelNoise noise = noise_of(bed(20, 1, 0.5, 0, 0, 5), setup);
  EXPECT_EQ(noise.source, NoiseSource::kSetup);
  EXPECT_EQ(noise.constant, 0.7);
  EXPECT_EQ(noise.degrees_of_freedom, 0);
  EXPECT_EQ(noise.day_offset, 0.35);
}

TEST(NoiseModel, WhatADayMayAddIsHeldPossibleWhereNoneCanBeTold) {
  const ChannelNoise replicates_on_one_day = [] {
    Bed made = bed(40, 3, 0.5, 0, 0, 8);
    for (WheelRun& run : made.recording.runs) run.day = 0;
    return noise_of(made);
  }();
  EXPECT_TRUE(replicates_on_one_day.day_assumed);
  EXPECT_EQ(replicates_on_one_day.day_offset, replicates_on_one_day.constant / 2);
  EXPECT_FALSE(noise_of(bed(40, 3, 0.5, 0, 0, 8)).day_assumed);
}

TEST(NoiseModel, WithoutReplicatesAndSetupNeighboursErrOnTheCautiousSide) {
  Bed made = bed(40, 1, 0.5, 0, 0, 6);
  for (std::size_t k = 0; k < made.conditions.size(); ++k) {
    made.conditions[k].load_n = 60;
    made.conditions[k].slip_ratio = 0.02 * static_cast<double>(k);
  }
  const ChannelNoise noise = noise_of(made);
  EXPECT_EQ(noise.source, NoiseSource::kNeighbours);
  EXPECT_GT(noise.constant, 0.3);
}

TEST(NoiseModel, IdenticalReplicatesAreAnError) {
  Bed made = bed(10, 3, 0, 0, 0, 7);
  EXPECT_THROW(noise_of(made), InputError);
}

}  // namespace
}  // namespace regoplan
