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

}  // namespace
}  // namespace regoplan
