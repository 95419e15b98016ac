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

/// The channels that are turned, where so many of ten runs have one of them turned.
std::vector<Channel> turned(Channel channel, int turned_of_ten) {
  const DiagnosisSetup setup = simulant_setup();
  int run_number = 0;
  const BedPlan plan{.instruments = [&](WheelRun& run) {
    if (++run_number % 10 < turned_of_ten) run.measured[static_cast<std::size_t>(channel)] *= -1;
  }};
  return condense(record({}, setup, setup.soil.mean, plan, 1), setup).turned;
}

TEST(CondensedRecording, AForceIsTurnedWhereNearlyAllOfItOpposesTheConvention) {
  for (const Channel channel : {Channel::kFy, Channel::kTorque}) {
    EXPECT_EQ(turned(channel, 0), std::vector<Channel>{});
    EXPECT_EQ(turned(channel, 3), std::vector<Channel>{});  // some other fault, which turning hides
    EXPECT_EQ(turned(channel, 5), std::vector<Channel>{});
    EXPECT_EQ(turned(channel, 10), std::vector{channel});
  }
}

}  // namespace
}  // namespace regoplan
