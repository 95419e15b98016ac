#include "diagnosis/recording/noise_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
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
  EXPECT_EQ(noise.degrees_of_freedom, 99);  // one of 100 tells how it grows with the signal
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

TEST(NoiseModel, DaysAndOutliersLeaveFewerDegreesOfFreedomToTheScatterOfARun) {
  const int without = noise_of(bed(40, 2, 0.5, 0, 0, 3)).degrees_of_freedom;
  EXPECT_GE(without, 38);
  EXPECT_LE(without, 40);
  // of 40 differences between two days one tells what these differ by
  const int of_two_days = noise_of(bed(40, 2, 0.5, 0, 1.5, 3)).degrees_of_freedom;
  EXPECT_LE(of_two_days, 39);
  Bed with_outlier = bed(40, 3, 0.5, 0, 0, 4);
  const int without_outlier = noise_of(with_outlier).degrees_of_freedom;
  with_outlier.value[31] += 8;
  EXPECT_LT(noise_of(with_outlier).degrees_of_freedom, without_outlier);
}

TEST(NoiseModel, WhatDaysDoToOtherChannelsIsHeldPossibleForAChannelThatDoesNotShowIt) {
  const ChannelNoise silent = noise_of(bed(40, 3, 0.5, 0, 0, 8)),
                     shown = noise_of(bed(40, 3, 0.5, 0, 1, 3));
  std::vector<ChannelNoise> alone{silent}, beside{silent, shown, shown};
  share_day_offsets(alone);
  share_day_offsets(beside);
  EXPECT_GT(beside[0].day_offset, 1.5 * alone[0].day_offset);
  EXPECT_LT(beside[0].day_offset, beside[1].day_offset);
}

TEST(NoiseModel, WhatDaysDoNotHappenToShowIsHeldPossibleTheMoreTheFewerTheyAre) {
  std::vector<ChannelNoise> few{noise_of(bed(40, 3, 0.5, 0, 0, 8))},
      many{noise_of(bed(40, 12, 0.5, 0, 0, 8))};
  share_day_offsets(few);
  share_day_offsets(many);
  EXPECT_GT(few[0].day_offset, 1.5 * many[0].day_offset);
  EXPECT_LT(few[0].day_offset, few[0].constant);
  EXPECT_GT(many[0].day_offset, 0);
}

TEST(NoiseModel, DaysThatAreNotToldAreSoughtInTheRoundsOfReplicates) {
  const auto untold = [](double day_deviation) {
    Bed made = bed(40, 3, 0.5, 0, day_deviation, 3);
    // a round of replicates after the other, and no column of days
    Recording rounds = made.recording;
    std::vector<double> value;
    for (std::size_t day = 0; day < 3; ++day) {
      for (std::size_t k = 0; k < made.conditions.size(); ++k) {
        const std::size_t run = made.conditions[k].runs[day];
        rounds.runs[value.size()] = made.recording.runs[run];
        rounds.runs[value.size()].day = 0;
        value.push_back(made.value[run]);
      }
    }
    for (std::size_t k = 0; k < made.conditions.size(); ++k) {
      for (std::size_t day = 0; day < 3; ++day) {
        made.conditions[k].runs[day] = day * made.conditions.size() + k;
      }
    }
    made.recording = rounds;
    made.value = value;
    std::vector<ChannelNoise> noise{noise_of(made)};
    share_day_offsets(noise);
    return noise[0];
  };
  const ChannelNoise quiet = untold(0), moved = untold(1.5);
  EXPECT_TRUE(moved.day_assumed);
  EXPECT_EQ(moved.untold_days, 3);
  EXPECT_GT(moved.day_offset, 1.5 * quiet.day_offset);
  EXPECT_GE(quiet.day_offset, quiet.constant / 2);
}

TEST(NoiseModel, NoDaysAreSoughtWhereOnlySomeConditionsWereRunAgain) {
  Bed made = bed(40, 1, 0.5, 0, 0, 5);
  for (std::size_t k = 0; k < 10; ++k) {
    const double again = made.value[k] + (k % 2 == 0 ? 0.4 : -0.4);
    made.conditions[k].runs.push_back(made.value.size());
    made.value.push_back(again);
    made.recording.runs.push_back(made.recording.runs[k]);
    made.recording.runs.back().measured[0] = again;
  }
  const ChannelNoise noise = noise_of(made);
  EXPECT_TRUE(noise.day_assumed);
  EXPECT_EQ(noise.untold_days, 0);
  EXPECT_TRUE(noise.day_log_likelihood.empty());
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

/// A run of each of so many conditions side by side, without signal.
Bed side_by_side(int conditions, const std::function<double()>& noise) {
  Bed made;
  made.conditions.resize(static_cast<std::size_t>(conditions));
  for (std::size_t k = 0; k < made.conditions.size(); ++k) {
    made.conditions[k] = {.load_n = 60, .slip_ratio = 0.02 * static_cast<double>(k), .runs = {k}};
    made.recording.runs.push_back({.load_n = 60});
    made.value.push_back(noise());
    made.recording.runs.back().measured[0] = made.value.back();
  }
  return made;
}

TEST(NoiseModel, NeighboursTellNoiseWithHeavyTailsAsWideAsItIs) {
  double ratio = 0;
  constexpr int kBeds = 20;
  for (int seed = 0; seed < kBeds; ++seed) {
    std::mt19937_64 random(static_cast<std::uint64_t>(seed));
    std::student_t_distribution<double> heavy(4);
    const double unit = std::sqrt(2.0);  // its deviation
    ratio += noise_of(side_by_side(80, [&] { return heavy(random) / unit; })).constant / kBeds;
  }
  EXPECT_GT(ratio, 0.85);
  EXPECT_LT(ratio, 1.1);
}

TEST(NoiseModel, FewReplicatesThatHappenToAgreeDoNotSetTheNoise) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  Bed made = side_by_side(60, [&] { return normal(random); });
  const auto run_again = [&made](std::size_t condition) {
    made.conditions[condition].runs.push_back(made.value.size());
    made.value.push_back(made.value[condition] + 0.4);
    made.recording.runs.push_back({.load_n = 60});
    made.recording.runs.back().measured[0] = made.value.back();
  };
  for (const std::size_t condition : {3, 17, 31, 46}) run_again(condition);
  const ChannelNoise few = noise_of(made);
  EXPECT_EQ(few.source, NoiseSource::kNeighbours);
  EXPECT_GT(few.neighbour_degrees_of_freedom, 10);
  EXPECT_NEAR(few.constant, 1, 0.25);
  DiagnosisSetup told;
  told.noise_standard_deviation[Channel::kFx] = 0.3;
  EXPECT_EQ(noise_of(made, told).source, NoiseSource::kReplicates);  // neighbours do not overrule
  for (const std::size_t condition : {8, 25, 40, 52, 55}) run_again(condition);
  EXPECT_EQ(noise_of(made).source, NoiseSource::kReplicates);
}

/// Few conditions run on two days that are an offset apart: of as many differences as days take
/// little is left that tells a run's own scatter.
TEST(NoiseModel, FewReplicatesOfDifferentDaysSeldomTellTooLittle) {
  constexpr int kBeds = 1000;
  int too_small = 0;
  for (int seed = 0; seed < kBeds; ++seed) {
    std::mt19937_64 random(static_cast<std::uint64_t>(seed));
    std::normal_distribution<double> normal;
    Bed made = side_by_side(24, [&] { return normal(random); });
    const double between = 0.4 * normal(random);
    for (const std::size_t condition : {2, 5, 8, 11, 14, 17, 20}) {
      made.conditions[condition].runs.push_back(made.value.size());
      made.value.push_back(between + normal(random));
      made.recording.runs.push_back({.load_n = 60, .day = 1});
      made.recording.runs.back().measured[0] = made.value.back();
    }
    too_small += usual_deviation(noise_of(made), made.value) < 0.5 ? 1 : 0;
  }
  EXPECT_LE(too_small, kBeds / 200);
}

TEST(NoiseModel, IdenticalReplicatesAreAnError) {
  Bed made = bed(10, 3, 0, 0, 0, 7);
  EXPECT_THROW(noise_of(made), InputError);
}

}  // namespace
}  // namespace regoplan
