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
  for (const Channel channel : {Channel::kFx, Channel::kFy, Channel::kTorque}) {
    EXPECT_EQ(turned(channel, 0), std::vector<Channel>{});
    EXPECT_EQ(turned(channel, 3), std::vector<Channel>{});  // some other fault, which turning hides
    EXPECT_EQ(turned(channel, 5), std::vector<Channel>{});
    EXPECT_EQ(turned(channel, 10), std::vector{channel});
  }
}

TEST(CondensedRecording, DrawbarPullIsNotTurnedForASensorsZeroOrSoilThatHoldsTheWheel) {
  const auto with_pull_off_by = [](double share_of_load, std::vector<double> slips) {
    const DiagnosisSetup setup = simulant_setup();
    const BedPlan plan{
        .slips = std::move(slips), .replicates = 1, .instruments = [&](WheelRun& run) {
          run.measured[static_cast<std::size_t>(Channel::kFx)] += share_of_load * run.load_n;
        }};
    return condense(record({}, setup, setup.soil.mean, plan, 1), setup).turned;
  };
  const std::vector<double> both_sides{-0.3, 0, 0.15, 0.3, 0.5, 0.8}, driving{0.15, 0.3, 0.5, 0.8};
  for (const double share : {-0.8, 0.8}) {
    EXPECT_EQ(with_pull_off_by(share, both_sides), std::vector<Channel>{});
    EXPECT_EQ(with_pull_off_by(share, driving), std::vector<Channel>{});
  }
}

}  // namespace
}  // namespace regoplan
