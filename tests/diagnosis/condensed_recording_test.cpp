#include "diagnosis/bed/condensed_recording.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "synthetic_bed.h"

namespace regoplan {
namespace {

bool doubted(double torque_noise_nm) {
  DiagnosisSetup setup = simulant_setup();
  setup.noise_standard_deviation = {{Channel::kFx, 1},
                                    {Channel::kFy, 1},
                                    {Channel::kTorque, torque_noise_nm},
                                    {Channel::kSinkage, 5e-4}};
  const BedPlan plan{.replicates = 1};
  const auto notes = condense(record({}, setup, setup.soil.mean, plan, 1), setup).notes;
  return std::ranges::any_of(notes, [](const std::string& note) {
    return note.find("torque_nm") == 0 && note.find("is the unit of the noise right?") != note.npos;
  });
}

TEST(CondensedRecording, NoiseBeyondAllThatIsMeasuredIsDoubted) {
  EXPECT_TRUE(doubted(90));  // N mm
  EXPECT_FALSE(doubted(0.09));
}

/// What a recording's side force is taken to be, where so many of ten runs have it turned.
double side_sign(int turned_of_ten) {
  const DiagnosisSetup setup = simulant_setup();
  int run_number = 0;
  const BedPlan plan{.instruments = [&](WheelRun& run) {
    if (++run_number % 10 < turned_of_ten) run.measured[1] *= -1;
  }};
  return condense(record({}, setup, setup.soil.mean, plan, 1), setup).side_sign;
}

TEST(CondensedRecording, ASideForceIsTurnedWhereNearlyAllOfItOpposesTheConvention) {
  EXPECT_EQ(side_sign(0), 1);
  EXPECT_EQ(side_sign(3), 1);  // some other fault, which turning all would hide
  EXPECT_EQ(side_sign(5), 1);
  EXPECT_EQ(side_sign(10), -1);
}

}  // namespace
}  // namespace regoplan
