#include "diagnosis/detection.h"

#include <gtest/gtest.h>

#include "diagnosis/calibration.h"
#include "diagnosis/location.h"
#include "synthetic_bed.h"

namespace regoplan {
namespace {

struct Calibrated {
  CondensedRecording recording;
  FitRemainder remainder;
};

Calibrated calibrated(const TrueWheel& truth, std::uint64_t seed, const BedPlan& plan = {}) {
  const DiagnosisSetup setup = simulant_setup();
  std::mt19937_64 random(seed);
  Calibrated made{condense(record(truth, setup, draw(setup.soil, random), plan, seed), setup), {}};
  const Calibration found = calibrate(made.recording.bed, soil_coordinates(setup.soil));
  made.remainder = {.residual = made.recording.bed.measured() - found.prediction,
                    .x = found.x,
                    .jacobian = found.jacobian};
  return made;
}

TrueWheel deep_in_slip() {
  TrueWheel wheel;
  wheel.sinkage = [](const WheelRun& run, double h) {
    return h + 0.006 * std::max(run.slip_ratio, 0.0);
  };
  return wheel;
}

TEST(LackOfFit, StaysSilentOnNoiseWithDaysAndOutliers) {
  int rejected = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Calibrated made = calibrated({}, seed);
    const LackOfFit found = lack_of_fit(made.recording, made.remainder, seed);
    rejected += found.f > found.critical;
  }
  EXPECT_LE(rejected, 1);
}

TEST(LackOfFit, SeesSinkageThatGrowsWithSlip) {
  const Calibrated made = calibrated(deep_in_slip(), 3);
  const LackOfFit found = lack_of_fit(made.recording, made.remainder, 3);
  EXPECT_GT(found.f, found.critical);
  EXPECT_LT(found.p_value, 0.005);
}

TEST(LackOfFit, IsTheSameForTheSameSeed) {
  const Calibrated made = calibrated({}, 4);
  EXPECT_EQ(lack_of_fit(made.recording, made.remainder, 9).critical,
            lack_of_fit(made.recording, made.remainder, 9).critical);
}

TEST(Location, FindsTheChannelAndTheSlipAngles) {
  TrueWheel wheel;
  wheel.fy_n = [](const WheelRun& run, double) {
    return std::abs(run.slip_angle_rad) > 0.25 ? 6.0 : 0.0;
  };
  const Calibrated made = calibrated(wheel, 5);
  const auto found = locate(made.recording, made.remainder, 5);
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found.front().channel, Channel::kFy);
  ASSERT_TRUE(found.front().region.contains("slip_angle_deg"));
  EXPECT_GT(found.front().region.at("slip_angle_deg")[0], 12);
  EXPECT_GT(found.front().ci95[0], 0);
}

TEST(Location, IsSilentWhereNothingDiffers) {
  int shown = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Calibrated made = calibrated({}, 100 + seed);
    shown += !locate(made.recording, made.remainder, seed).empty();
  }
  EXPECT_LE(shown, 2);
}

}  // namespace
}  // namespace regoplan
