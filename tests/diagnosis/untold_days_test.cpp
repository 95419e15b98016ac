// A recording that does not tell its days shows them in rounds of replicates.
#include "diagnosis/recording/untold_days.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <tuple>

#include "diagnosis/bed/condensed_recording.h"
#include "synthetic_bed.h"

namespace regoplan {
namespace {

constexpr std::size_t kConditions = 40, kRounds = 3;

/// Rounds of replicates, each in an order of its own; every round is off by a day's offset.
Recording in_rounds(double day_n, std::uint64_t seed) {
  const DiagnosisSetup setup = simulant_setup();
  Recording recording = record({}, setup, setup.soil.mean,
                               {.conditions = kConditions, .replicates = kRounds, .day = 0}, seed);
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  for (std::size_t round = 0; round < kRounds; ++round) {
    const auto from = recording.runs.begin() + static_cast<std::ptrdiff_t>(round * kConditions);
    std::shuffle(from, from + kConditions, random);
    const double offset = day_n * normal(random);
    for (auto run = from; run != from + kConditions; ++run) {
      run->day = 0;
      run->measured[0] += offset;
    }
  }
  return recording;
}

std::size_t days_of(const Recording& recording) {
  const std::vector<double> day = condense(recording, simulant_setup()).day;
  return std::set(day.begin(), day.end()).size();
}

TEST(UntoldDays, AreTakenForDaysAndNotForScatter) {
  const CondensedRecording still = condense(in_rounds(0, 2), simulant_setup()),
                           moved = condense(in_rounds(1.5, 2), simulant_setup());
  EXPECT_EQ(days_of(in_rounds(1.5, 2)), kRounds);
  EXPECT_LT(moved.noise[0].constant, 1.1 * still.noise[0].constant);
  EXPECT_GT(moved.noise[0].day_offset, still.noise[0].constant / 2);
  EXPECT_FALSE(moved.noise[0].day_assumed);
  EXPECT_EQ(moved.notes.front().find("replicates differ by their round: 3 days"), 0);
}

TEST(UntoldDays, AreNoneWhereRoundsOnlyScatter) {
  int taken = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) taken += days_of(in_rounds(0, seed)) > 1;
  EXPECT_LE(taken, 1);
}

TEST(UntoldDays, AreNoneWhereReplicatesFollowEachOther) {
  Recording recording = in_rounds(3, 2);
  std::ranges::stable_sort(recording.runs, {}, [](const WheelRun& run) {
    return std::tuple(run.load_n, run.slip_ratio, run.slip_angle_rad);
  });
  EXPECT_EQ(days_of(recording), 1);
}

TEST(UntoldDays, AreNoneWhereTimesOrDaysAreTold) {
  Recording timed = in_rounds(3, 2);
  timed.columns.time = true;
  for (std::size_t i = 0; i < timed.runs.size(); ++i) {
    timed.runs[i].conditions.time_s = 600 * static_cast<double>(i);
  }
  EXPECT_EQ(days_of(timed), 1);
  Recording dated = in_rounds(3, 2);
  for (std::size_t i = dated.runs.size() / 2; i < dated.runs.size(); ++i) dated.runs[i].day = 1;
  EXPECT_EQ(days_of(dated), 2);
}

TEST(UntoldDays, AreNoneWhereOnlySomeConditionsWereRunAgain) {
  Recording recording = in_rounds(3, 2);
  recording.runs.resize(kConditions + kConditions / 4);
  EXPECT_EQ(days_of(recording), 1);
}

}  // namespace
}  // namespace regoplan
