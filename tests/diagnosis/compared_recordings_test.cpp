#include "diagnosis/bed/compared_recordings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "synthetic_bed.h"

namespace regoplan {
namespace {

Recording sound(std::uint64_t seed, int replicates, double noise = 1) {
  const DiagnosisSetup setup = simulant_setup();
  const BedPlan plan{
      .conditions = 24, .replicates = replicates, .noise = noise, .day = 0, .outliers = 0};
  return record({}, setup, setup.soil.mean, plan, seed);
}

ComparedRecordings alike(const Recording& test, const Recording& reference) {
  const DiagnosisSetup setup = simulant_setup();
  return read_alike(test, setup, {{"reference", reference, setup}}, {});
}

TEST(ReadAlike, NeitherIsTakenToScatterLessThanBothTogether) {
  const DiagnosisSetup setup = simulant_setup();
  const Recording quiet = sound(1, 3, 0.5), loud = sound(2, 3, 1.5);
  const CondensedRecording quiet_alone = condense(quiet, setup), loud_alone = condense(loud, setup);
  const ComparedRecordings compared = alike(quiet, loud);
  for (std::size_t c = 0; c < compared.test.noise.size(); ++c) {
    const ChannelNoise &a = quiet_alone.noise[c], &b = loud_alone.noise[c];
    const double pooled = std::sqrt((a.degrees_of_freedom * a.constant * a.constant +
                                     b.degrees_of_freedom * b.constant * b.constant) /
                                    (a.degrees_of_freedom + b.degrees_of_freedom));
    EXPECT_LT(a.constant, pooled);
    EXPECT_NEAR(compared.test.noise[c].constant, pooled, 1e-9 * pooled);
    EXPECT_EQ(compared.test.noise[c].degrees_of_freedom,
              a.degrees_of_freedom + b.degrees_of_freedom);
    EXPECT_NEAR(compared.references[0].noise[c].constant, b.constant, 1e-9 * pooled);
  }
}

TEST(ReadAlike, WhoHasNoReplicatesTakesTheScatterOfThoseThatHaveThem) {
  const ComparedRecordings compared = alike(sound(1, 1), sound(2, 4));
  for (std::size_t c = 0; c < compared.test.noise.size(); ++c) {
    const ChannelNoise &own = compared.test.noise[c], &lender = compared.references[0].noise[c];
    EXPECT_EQ(own.source, NoiseSource::kSetup);
    EXPECT_EQ(own.degrees_of_freedom, lender.degrees_of_freedom);  // as sure as the lender, no more
    EXPECT_NEAR(own.constant, lender.constant, 0.5 * lender.constant);
  }
}

TEST(ReadAlike, AReferenceWithoutReplicatesTakesTheScatterOfTheTest) {
  const ComparedRecordings compared = alike(sound(1, 4), sound(2, 1));
  for (std::size_t c = 0; c < compared.test.noise.size(); ++c) {
    const ChannelNoise &lender = compared.test.noise[c], &own = compared.references[0].noise[c];
    EXPECT_EQ(own.source, NoiseSource::kSetup);
    EXPECT_NEAR(own.constant, lender.constant, 0.5 * lender.constant);
  }
}

TEST(ReadAlike, ATestOfAFewRunsTakesWhatNeighbouringConditionsOfItsReferenceTell) {
  Recording few = sound(1, 1);
  few.runs.resize(3);
  const ComparedRecordings compared = alike(few, sound(2, 1));
  for (std::size_t c = 0; c < compared.test.noise.size(); ++c) {
    const ChannelNoise &own = compared.test.noise[c], &lender = compared.references[0].noise[c];
    EXPECT_EQ(lender.source, NoiseSource::kNeighbours);
    EXPECT_EQ(own.constant, lender.constant);
    EXPECT_EQ(own.degrees_of_freedom, lender.neighbour_degrees_of_freedom);
  }
}

/// So many conditions were run twice, the others once.
Recording with_few_replicates(std::uint64_t seed, std::size_t replicates) {
  Recording recording = sound(seed, 2);
  recording.runs.resize(recording.runs.size() / 2 + replicates);
  return recording;
}

TEST(ReadAlike, ReplicatesThatAreTooFewInEachTellTheScatterTogether) {
  const Recording test = with_few_replicates(1, 5), reference = with_few_replicates(2, 5);
  const DiagnosisSetup setup = simulant_setup();
  constexpr std::array kTrue{1.0, 1.0, 0.09, 5e-4};  // as BedPlan has it
  const CondensedRecording alone = condense(test, setup);
  const ComparedRecordings compared = alike(test, reference);
  ASSERT_EQ(compared.test.noise.size(), kTrue.size());
  for (std::size_t c = 0; c < alone.noise.size(); ++c) {
    EXPECT_NE(compared.test.noise[c].source, NoiseSource::kNeighbours);
    EXPECT_NE(compared.references[0].noise[c].source, NoiseSource::kNeighbours);
    EXPECT_NEAR(compared.test.noise[c].constant, kTrue.at(c), 0.5 * kTrue.at(c));
  }
  EXPECT_TRUE(std::ranges::any_of(alone.noise, [](const ChannelNoise& noise) {
    return noise.source == NoiseSource::kNeighbours;
  }));
}

/// Every condition of a grid once, by a wheel whose pull goes up and down with slip as no model has
/// it.
Recording wavy(std::uint64_t seed) {
  const DiagnosisSetup setup = simulant_setup();
  const BedPlan plan{.loads_n = {64.7}, .conditions = 24, .replicates = 1, .day = 0, .outliers = 0};
  TrueWheel wheel;
  wheel.fx_n = [](const WheelRun& run, double) { return 8 * std::sin(25 * run.slip_ratio); };
  return record(wheel, setup, setup.soil.mean, plan, seed);
}

TEST(ReadAlike, WithoutReplicatesWhatASmoothDifferenceLeavesTellsTheScatter) {
  const Recording test = wavy(1), reference = wavy(2);
  const ChannelNoise alone = condense(test, simulant_setup()).noise.front();
  ASSERT_EQ(alone.channel, Channel::kFx);
  EXPECT_EQ(alone.source, NoiseSource::kNeighbours);
  EXPECT_GT(alone.constant, 2);  // N, where one run scatters by 1
  const ComparedRecordings compared = alike(test, reference);
  const ChannelNoise &own = compared.test.noise.front(),
                     &of_reference = compared.references[0].noise.front();
  EXPECT_NEAR(own.constant, 1, 0.4);
  EXPECT_EQ(own.constant, of_reference.constant);
  EXPECT_EQ(own.degrees_of_freedom, 24 - 7);
  EXPECT_TRUE(std::ranges::any_of(compared.notes, [](const std::string& note) {
    return note.starts_with("fx_n") && note.find("a smooth difference") != std::string::npos;
  }));
}

TEST(ReadAlike, OfReferencesWithoutReplicatesTheOneWithMostLikeConditionsTellsTheScatter) {
  const DiagnosisSetup setup = simulant_setup();
  const Recording test = wavy(1);
  Recording fewer = wavy(2);
  fewer.runs.resize(20);
  const Reference few{"few", fewer, setup}, all{"all", wavy(3), setup};
  const ComparedRecordings forth = read_alike(test, setup, {few, all}, {});
  const ComparedRecordings back = read_alike(test, setup, {all, few}, {});
  EXPECT_EQ(forth.test.noise.front().degrees_of_freedom, 24 - 7);
  EXPECT_EQ(forth.test.noise.front().constant, back.test.noise.front().constant);
}

TEST(ReadAlike, SeriesWithoutLikeConditionsKeepTheScatterBetweenNeighbours) {
  const Recording test = wavy(1);
  Recording elsewhere = wavy(2);
  for (WheelRun& run : elsewhere.runs) run.conditions.speed_mps = 0.5;
  const ComparedRecordings compared = alike(test, elsewhere);
  EXPECT_EQ(compared.test.noise.front().source, NoiseSource::kNeighbours);
}

TEST(ReadAlike, ReferencesAreTheSameInWhateverOrderTheyAreGiven) {
  const DiagnosisSetup setup = simulant_setup();
  const Recording test = sound(1, 1);
  const Reference few{"few", sound(2, 1), setup}, some{"some", sound(3, 2, 0.7), setup},
      many{"many", sound(4, 4), setup};
  const ComparedRecordings forth = read_alike(test, setup, {few, some, many}, {});
  const ComparedRecordings back = read_alike(test, setup, {many, some, few}, {});
  const auto expect_alike = [](const CondensedRecording& a, const CondensedRecording& b) {
    ASSERT_EQ(a.noise.size(), b.noise.size());
    for (std::size_t c = 0; c < a.noise.size(); ++c) {
      EXPECT_EQ(a.noise[c].source, b.noise[c].source);
      EXPECT_NEAR(a.noise[c].constant, b.noise[c].constant, 1e-9 * b.noise[c].constant);
    }
  };
  expect_alike(forth.test, back.test);
  for (const std::size_t r : {0, 1, 2}) expect_alike(forth.references[r], back.references[2 - r]);
}

TEST(ReadAlike, OnlyChannelsThatBothMeasuredAreCompared) {
  Recording without_torque = sound(2, 3);
  std::erase(without_torque.channels, Channel::kTorque);
  for (WheelRun& run : without_torque.runs) {
    run.measured[static_cast<std::size_t>(Channel::kTorque)] = WheelRun::kNotMeasured;
  }
  const ComparedRecordings compared = alike(sound(1, 3), without_torque);
  for (const ChannelData& data : compared.test.bed.channels) {
    EXPECT_NE(data.channel, Channel::kTorque);
  }
  EXPECT_TRUE(
      std::ranges::count(compared.notes, "not compared, as a reference lacks it: torque_nm") == 1);
}

}  // namespace
}  // namespace regoplan
