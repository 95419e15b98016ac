#include "benchmarks/diagnosis/challenge.h"

#include <gtest/gtest.h>

#include <cmath>

#include "benchmarks/diagnosis/challenge_files.h"
#include "terramech/basics/input_error.h"

namespace regoplan::challenge {
namespace {

TEST(Challenge, IsTheSameForTheSameSeedAndItsTruthComesBackFromItsFile) {
  for (const Stratum stratum : strata()) {
    const Challenge a = generate(stratum, 5, 2), b = generate(stratum, 5, 2);
    EXPECT_EQ(recording_csv(a.recording), recording_csv(b.recording)) << name(stratum);
    EXPECT_EQ(setup_yaml(a.setup), setup_yaml(b.setup)) << name(stratum);
    EXPECT_EQ(truth_json(a.truth), truth_json(b.truth)) << name(stratum);
    EXPECT_EQ(truth_json(truth_from(truth_json(a.truth))), truth_json(a.truth)) << name(stratum);
  }
}

TEST(Challenge, DiffersWithSeedAndIndex) {
  const std::string one = recording_csv(generate(Stratum::kNulls, 5, 2).recording);
  EXPECT_NE(one, recording_csv(generate(Stratum::kNulls, 6, 2).recording));
  EXPECT_NE(one, recording_csv(generate(Stratum::kNulls, 5, 3).recording));
}

TEST(Challenge, KeepsTheTermsOfItsStratum) {
  for (std::uint64_t index = 0; index < 3; ++index) {
    EXPECT_TRUE(generate(Stratum::kNulls, 7, index).truth.causes.empty());
    const Truth parameters = generate(Stratum::kParameters, 7, index).truth;
    EXPECT_GE(parameters.signal.before, 10);
    for (const TrueCause& cause : parameters.causes) {
      EXPECT_GE(std::abs(cause.amplitude), 2);
      EXPECT_LE(std::abs(cause.amplitude), 4);
    }
    EXPECT_GE(generate(Stratum::kOneEffect, 7, index).truth.signal.after, 5);
    EXPECT_GE(generate(Stratum::kUnlisted, 7, index).truth.signal.after, 8);
    EXPECT_TRUE(generate(Stratum::kInstruments, 7, index).truth.causes.at(0).instrument);
    EXPECT_TRUE(generate(Stratum::kLargeFaults, 7, index).truth.causes.at(0).instrument);
  }
}

TEST(Challenge, DriftIsClearAndWhatABedRemembersHasNoName) {
  for (std::uint64_t index = 0; index < 4; ++index) {
    const Truth truth = generate(Stratum::kDrift, 7, index).truth;
    EXPECT_GE(truth.signal.after, 8);
    ASSERT_EQ(truth.causes.size(), 1);
    EXPECT_EQ(truth.causes[0].accepted.empty(), truth.causes[0].id == "bed_memory");
  }
}

TEST(Challenge, WhatPassesInTheCourseOfDaysTellsReplicatesApart) {
  for (std::uint64_t index = 0; index < 6; ++index) {
    const Challenge made = generate(Stratum::kDriftByRun, 7, index);
    EXPECT_GE(made.truth.signal.after, 8);
    ASSERT_EQ(made.truth.causes.size(), 1);
    const TrueCause& cause = made.truth.causes[0];
    EXPECT_FALSE(cause.accepted.empty()) << cause.id;
    if (cause.id == "bed_preparation") {
      EXPECT_EQ(cause.accepted, std::vector<std::string>{"soil_change"});
    }
    if (!made.recording.columns.time) continue;
    double before_s = -1;
    for (const WheelRun& run : made.recording.runs) {
      EXPECT_GT(run.conditions.time_s, before_s) << run.run_id << " of case " << index;
      before_s = run.conditions.time_s;
    }
  }
}

TEST(Challenge, TwoEffectsAreTwoNamesEachBeyondTheOther) {
  const Truth truth = generate(Stratum::kTwoEffects, 7, 1).truth;
  ASSERT_EQ(truth.causes.size(), 2);
  EXPECT_NE(truth.causes[0].id, truth.causes[1].id);
  for (const TrueCause& cause : truth.causes) EXPECT_GE(cause.signal, 8);
}

TEST(Challenge, RecordsFortyToAHundredAndThirtyRuns) {
  for (std::uint64_t index = 0; index < 15; ++index) {
    const Recording recording = generate(Stratum::kNulls, 9, index).recording;
    EXPECT_GE(recording.runs.size(), 40) << index;
    EXPECT_LE(recording.runs.size(), 130) << index;
  }
}

TEST(Challenge, NullsOfFewRepeatFewConditions) {
  for (std::uint64_t index = 0; index < 4; ++index) {
    const Challenge made = generate(Stratum::kNullsOfFew, 7, index);
    EXPECT_TRUE(made.truth.causes.empty());
    EXPECT_TRUE(made.setup.noise_standard_deviation.empty());
    EXPECT_GE(made.recording.runs.size(), 20);
    EXPECT_LE(made.recording.runs.size(), 90);
  }
}

TEST(Challenge, StatesTheNoiseThatItMakes) {
  int stated = 0;
  for (std::uint64_t index = 0; index < 6; ++index) {
    const Challenge made = generate(Stratum::kRutShown, 20261122, index);
    for (const auto& [channel, deviation] : made.setup.noise_standard_deviation) {
      double largest = 0;
      for (const WheelRun& run : made.recording.runs) {
        largest = std::max(largest, std::abs(run.value(channel)));
      }
      EXPECT_LT(deviation, 0.5 * largest) << name(channel) << " of case " << index;
      ++stated;
    }
  }
  EXPECT_GT(stated, 0);
}

TEST(Challenge, TellsRutDepthsInOneStratumOnly) {
  const auto tells = [](Stratum stratum) {
    const Recording recording = generate(stratum, 7, 0).recording;
    return std::ranges::count(recording.channels, Channel::kRutLeft) == 1;
  };
  EXPECT_TRUE(tells(Stratum::kRutShown));
  EXPECT_FALSE(tells(Stratum::kRutHidden));
}

TEST(Challenge, WritesNoTruthWhereADiagnosisLooks) {
  const Challenge challenge = generate(Stratum::kOneEffect, 7, 0);
  const std::string seen = recording_csv(challenge.recording) + setup_yaml(challenge.setup);
  EXPECT_EQ(seen.find(challenge.truth.causes.at(0).id), std::string::npos);
}

TEST(Challenge, RefusesAStratumThatItDoesNotKnow) {
  EXPECT_THROW(stratum_named("null"), InputError);
}

}  // namespace
}  // namespace regoplan::challenge
