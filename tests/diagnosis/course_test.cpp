// Time is a place: what replicates follow is no scatter.
#include "diagnosis/recording/course.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>

#include "diagnosis/bed/condensed_recording.h"
#include "diagnosis/checks/location.h"
#include "synthetic_bed.h"

namespace regoplan {
namespace {

Recording recorded(std::uint64_t seed, double drift_n) {
  const DiagnosisSetup setup = simulant_setup();
  Recording recording = record({}, setup, setup.soil.mean, {.conditions = 30, .day = 0}, seed);
  const auto n = static_cast<double>(recording.runs.size());
  for (std::size_t i = 0; i < recording.runs.size(); ++i) {
    recording.runs[i].day = 0;
    recording.runs[i].measured[0] += drift_n * static_cast<double>(i) / n;
  }
  return recording;
}

TEST(Course, OfReplicatesThatOnlyScatterIsNone) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6}) {
    EXPECT_FALSE(condense(recorded(seed, 0), simulant_setup()).course.has_value()) << seed;
  }
}

/// Twenty conditions in any order, four of them run twice.
Recording with_few_replicates(std::uint64_t seed) {
  const DiagnosisSetup setup = simulant_setup();
  Recording recording =
      record({}, setup, setup.soil.mean, {.conditions = 20, .replicates = 2, .day = 0}, seed);
  recording.runs.resize(24);  // the second round ends with its fourth condition
  std::mt19937_64 random(seed);
  std::ranges::shuffle(recording.runs, random);
  for (WheelRun& run : recording.runs) run.day = 0;
  return recording;
}

TEST(Course, OfAFewReplicatesThatOnlyScatterIsNone) {
  int followed = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const CondensedRecording found = condense(with_few_replicates(seed), simulant_setup());
    followed += found.course.has_value();
  }
  EXPECT_LE(followed, 1);
}

TEST(Course, OfATimeThatReplicatesShareIsNoneWhateverTheirLoadsDo) {
  const DiagnosisSetup setup = simulant_setup();
  Recording recording = record({}, setup, setup.soil.mean, {.conditions = 40, .day = 0}, 1);
  recording.columns.time = true;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> within(-0.03, 0.03);
  for (WheelRun& run : recording.runs) {
    // Each condition at a time of its own; later ones answer to load more than the model does.
    run.conditions.time_s = 1e4 * (0.3 + run.slip_ratio + run.slip_angle_rad);
    run.day = 0;
    const double heavier = within(random);
    run.load_n *= 1 + heavier;
    run.measured[0] += 0.02 * run.conditions.time_s * heavier;
  }
  EXPECT_FALSE(condense(recording, setup).course.has_value());
}

TEST(Course, OfOneRunThatHasNoRunBeforeItIsNone) {
  const DiagnosisSetup setup = simulant_setup();
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    // Every round in the same order: only the first run of all follows another one than its
    // replicates do.
    Recording recording =
        record({}, setup, setup.soil.mean, {.conditions = 18, .replicates = 3}, seed);
    std::array<double, kChannelCount>& first = recording.runs.front().measured;
    first[0] -= 3;
    first[1] -= 3;
    first[3] -= 2e-3;
    const CondensedRecording found = condense(recording, setup);
    EXPECT_FALSE(found.course && found.course->column == "after_slip_ratio") << seed;
  }
}

TEST(Course, IsFoundAndDoesNotWidenTheNoise) {
  Recording shuffled = recorded(7, 0);
  // replicates far apart in the order, as on a bed that is tested round by round
  std::mt19937_64 random(1);
  std::shuffle(shuffled.runs.begin(), shuffled.runs.end(), random);
  const double still = condense(shuffled, simulant_setup()).noise[0].constant;
  const auto n = static_cast<double>(shuffled.runs.size());
  for (std::size_t i = 0; i < shuffled.runs.size(); ++i) {
    shuffled.runs[i].measured[0] += 6 * static_cast<double>(i) / n;
  }
  // Told neither time nor day, three days do as well: of the drift only what it does within a round
  // is scatter.
  const CondensedRecording untold = condense(shuffled, simulant_setup());
  EXPECT_FALSE(untold.course.has_value());
  EXPECT_EQ(std::set(untold.day.begin(), untold.day.end()).size(), 3);
  EXPECT_LT(untold.noise[0].constant, 1.5 * still);

  // A time that is the same for all replicates of a condition does not say when they were run.
  shuffled.columns.time = true;
  for (const Condition& at : untold.bed.conditions) {
    for (const std::size_t run : at.runs) {
      shuffled.runs[run].conditions.time_s = 600 * static_cast<double>(at.runs.front());
    }
  }
  const CondensedRecording shared = condense(shuffled, simulant_setup());
  EXPECT_FALSE(shared.course.has_value());
  EXPECT_LT(shared.noise[0].constant, 1.5 * still);

  for (std::size_t i = 0; i < shuffled.runs.size(); ++i) {
    shuffled.runs[i].conditions.time_s = 600 * static_cast<double>(i);
  }
  const CondensedRecording found = condense(shuffled, simulant_setup());
  ASSERT_TRUE(found.course.has_value());
  EXPECT_TRUE(found.course->in_time());
  EXPECT_LT(found.noise[0].constant, 1.25 * still);
}

/// Three rounds of replicates, each on a day of its own.
/// \param firmer share by which drawbar pull and torque are larger on the second
Recording on_three_days(std::uint64_t seed, double firmer) {
  const DiagnosisSetup setup = simulant_setup();
  Recording recording = record({}, setup, setup.soil.mean, {.conditions = 30, .day = 1}, seed);
  recording.columns.day = true;
  for (WheelRun& run : recording.runs) {
    if (run.day != 1) continue;
    run.measured[0] *= 1 + firmer;
    run.measured[2] *= 1 + firmer;
  }
  return recording;
}

TEST(Course, OfDaysThatDifferAsMuchAsARunScattersIsNone) {
  int followed = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    followed += condense(on_three_days(seed, 0), simulant_setup()).course.has_value();
  }
  EXPECT_LE(followed, 1);
}

/// Sinkages that are much alike, each day's off by about as much as one run scatters.
Recording with_sinkages_alike(std::uint64_t seed) {
  constexpr double kScatter_m = 1e-3;
  Recording recording = on_three_days(seed, 0);
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const std::array<double, 3> off = {normal(random), normal(random), normal(random)};
  for (WheelRun& run : recording.runs) {
    run.measured[3] =
        0.02 + kScatter_m * (off.at(static_cast<std::size_t>(run.day)) + normal(random));
  }
  return recording;
}

TEST(Course, OfDaysThatDifferAsMuchAsARunScattersIsNoneWhereSignalsAreAlike) {
  int followed = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    followed += condense(with_sinkages_alike(seed), simulant_setup()).course.has_value();
  }
  EXPECT_LE(followed, 1);
}

TEST(Course, ADayWhoseBedIsFirmerIsNoScatterOfDays) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const CondensedRecording found = condense(on_three_days(seed, 0.15), simulant_setup());
    ASSERT_TRUE(found.course.has_value()) << seed;
    EXPECT_TRUE(found.course->in_time());
    EXPECT_EQ(found.course->column, "on_day");
    EXPECT_EQ(found.course->low, 2) << "days count from 1";
    EXPECT_EQ(found.course->high, 2);
    for (const ChannelNoise& noise : found.noise) EXPECT_LT(noise.day_gain, 0.05) << seed;
  }
}

TEST(Course, ALocationInDaysGoesByTheRecordingsOwnNumbers) {
  Recording recording = recorded(1, 0);
  recording.columns.day = true;
  for (std::size_t i = 0; i < recording.runs.size(); ++i) {
    constexpr std::size_t kFirstDay = 11, kRunsADay = 9;
    const auto later = static_cast<double>(i / kRunsADay);
    recording.runs[i].day = kFirstDay + later;
    recording.runs[i].measured[0] += 2 * later;
  }
  const CondensedRecording found = condense(recording, simulant_setup());
  ASSERT_TRUE(found.course.has_value());
  ASSERT_EQ(found.course->column, "day");
  const auto when = last_part_of(found);
  ASSERT_TRUE(when.has_value());
  EXPECT_EQ(when->region.at("day"), (std::array<double, 2>{18, 20}));
}

TEST(Course, OneThatGainsTooLittleIsNotedAndChangesNothing) {
  const auto told_as_doubtful = [](const CondensedRecording& found) {
    return std::ranges::any_of(found.notes, [](const std::string& note) {
      return note.starts_with("replicates may differ on day 2 of the recording");
    });
  };
  int doubtful = 0, by_chance = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const CondensedRecording found = condense(on_three_days(seed, 0.06), simulant_setup());
    EXPECT_FALSE(told_as_doubtful(found) && found.course.has_value()) << seed;
    doubtful += told_as_doubtful(found);
    by_chance += told_as_doubtful(condense(on_three_days(seed, 0), simulant_setup()));
  }
  EXPECT_GT(doubtful, by_chance);
}

TEST(Course, WhereOnlyTimesAreToldANightBeginsTheNextDay) {
  Recording recording = on_three_days(4, 0);
  const std::vector<double> told = condense(recording, simulant_setup()).day;
  recording.columns.day = false;
  recording.columns.time = true;
  for (std::size_t i = 0; i < recording.runs.size(); ++i) {
    WheelRun& run = recording.runs[i];
    run.conditions.time_s = 86400 * run.day + 300 * static_cast<double>(i % 30);
    run.day = 0;
  }
  EXPECT_EQ(condense(recording, simulant_setup()).day, told);
}

/// Runs of one day in any order, the zero of drawbar pull off on a part of them.
Recording off_for_a_time(std::uint64_t seed, double zero_n, std::array<double, 2> part) {
  Recording recording = recorded(seed, 0);
  std::mt19937_64 random(seed);
  std::ranges::shuffle(recording.runs, random);
  const auto n = static_cast<double>(recording.runs.size());
  for (std::size_t i = 0; i < recording.runs.size(); ++i) {
    const auto at = static_cast<double>(i);
    recording.runs[i].conditions.time_s = 600 * at;
    if (at >= part[0] * n && at < part[1] * n) recording.runs[i].measured[0] += zero_n;
  }
  return recording;
}

/// A part of the runs, as shares of their number; the shorter lies within one quarter of them.
class ForATime : public testing::TestWithParam<std::array<double, 2>> {};
INSTANTIATE_TEST_SUITE_P(Course, ForATime,
                         testing::Values(std::array{0.4, 0.8}, std::array{0.3125, 0.4375}));

TEST_P(ForATime, WhatDiffersIsToldWithItsEdges) {
  Recording recording = off_for_a_time(5, 6, GetParam());
  recording.columns.time = true;
  const CondensedRecording found = condense(recording, simulant_setup());
  ASSERT_TRUE(found.course.has_value());
  EXPECT_TRUE(found.course->for_a_time());
  EXPECT_EQ(found.course->column, "time_s");
  const double whole_s = 600 * static_cast<double>(recording.runs.size());
  EXPECT_NEAR(found.course->low / whole_s, GetParam()[0], 0.07);
  EXPECT_NEAR(found.course->high / whole_s, GetParam()[1], 0.07);
  ASSERT_FALSE(found.bed.times_apart_s.empty());
  const Span& apart = found.bed.times_apart_s[0];
  for (const Condition& at : found.bed.conditions) {
    const double time_s = at.conditions.time_s;
    const bool inside = time_s >= apart.low && time_s <= apart.high;
    for (const std::size_t run : at.runs) {
      EXPECT_EQ(found.course->value[run] > 0, inside)
          << "no condition lies on both sides of an edge";
    }
  }
}

TEST(Course, WhereNeitherTimesNorDaysAreToldRunsFollowEachOtherEvenly) {
  const Recording recording = off_for_a_time(5, 6, {0.4, 0.8});
  const CondensedRecording found = condense(recording, simulant_setup());
  ASSERT_TRUE(found.course.has_value());
  EXPECT_EQ(found.course->column, "run_order");
  ASSERT_FALSE(found.bed.times_apart_s.empty());
  const double last_s = 3 * 86400.0 * (1 - 1.0 / static_cast<double>(recording.runs.size()));
  EXPECT_NEAR(found.bed.times_apart_s[0].low / last_s, 0.4, 0.07) << "three replicates: three days";
  EXPECT_NEAR(found.bed.times_apart_s[0].high / last_s, 0.8, 0.07);
  EXPECT_TRUE(std::ranges::any_of(found.notes, [](const std::string& note) {
    return note.starts_with("the recording tells no times");
  }));
}

/// Replicates each at a place of its own, as a wheel that rolls on has them.
/// \param firmer_n by which drawbar pull is larger on the second half of the bed
Recording along_a_bed(std::uint64_t seed, double firmer_n) {
  Recording recording = recorded(seed, 0);
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> along_m(0, 2);
  recording.columns.position = true;
  for (WheelRun& run : recording.runs) {
    run.conditions.position_m = along_m(random);
    if (run.conditions.position_m > 1) run.measured[0] += firmer_n;
  }
  return recording;
}

TEST(Course, ReplicatesTellTheNoiseWhereverOnTheBedTheyLie) {
  const CondensedRecording untold = condense(recorded(8, 0), simulant_setup());
  const CondensedRecording found = condense(along_a_bed(8, 0), simulant_setup());
  EXPECT_FALSE(found.course.has_value());
  EXPECT_EQ(found.bed.conditions.size(), found.used.size()) << "conditions stay where they were";
  for (std::size_t c = 0; c < found.noise.size(); ++c) {
    EXPECT_EQ(found.noise[c].source, NoiseSource::kReplicates);
    EXPECT_DOUBLE_EQ(found.noise[c].constant, untold.noise[c].constant);
  }
}

TEST(Course, OtherSoilOnAStretchOfTheBedDoesNotWidenTheNoise) {
  const double still = condense(along_a_bed(8, 0), simulant_setup()).noise[0].constant;
  const CondensedRecording found = condense(along_a_bed(8, 6), simulant_setup());
  ASSERT_TRUE(found.course.has_value());
  EXPECT_TRUE(found.course->in_place());
  EXPECT_NEAR(found.course->low, 1, 0.15);
  EXPECT_LT(found.noise[0].constant, 1.25 * still);
}

TEST(Course, OfReplicatesAlongABedThatOnlyScatterIsNone) {
  int followed = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    followed += condense(along_a_bed(seed, 0), simulant_setup()).course.has_value();
  }
  EXPECT_EQ(followed, 0);
}

}  // namespace
}  // namespace regoplan
