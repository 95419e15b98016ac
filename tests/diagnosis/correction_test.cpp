#include "diagnosis/names/correction.h"

#include <gtest/gtest.h>

#include "synthetic_bed.h"

namespace regoplan {
namespace {

CondensedRecording recorded(const TrueWheel& truth) {
  const DiagnosisSetup setup = simulant_setup();
  return condense(record(truth, setup, setup.soil.mean, {.outliers = 0}, 3), setup);
}

Correction corrected(const TrueWheel& truth) {
  return calibrated_alone(CalibratedRecording(recorded(truth)), 2);
}

/// A pull that no soil gives: numbers that come near to it spoil the side force.
TrueWheel with_a_pull_beyond_any_soil() {
  TrueWheel truth;
  truth.fx_n = [](const WheelRun& run, double) { return 25 * std::max(run.slip_ratio, 0.0); };
  return truth;
}

TEST(Correction, CalibratedSoilIsHandedOnWhereTheModelHolds) {
  const Correction correction = corrected({});
  EXPECT_EQ(correction.refused, "");
}

TEST(Correction, SoilNumbersThatPredictAChannelWorseThanThePriorMeansAreNotHandedOn) {
  const Correction correction = corrected(with_a_pull_beyond_any_soil());
  EXPECT_NE(correction.refused.find("the soil stays at its prior means"), std::string::npos)
      << correction.refused;
  EXPECT_EQ(correction.soil.mean.cohesion_pa, simulant_setup().soil.mean.cohesion_pa);
  EXPECT_EQ(correction.soil.mean.friction_angle_rad, simulant_setup().soil.mean.friction_angle_rad);
}

TEST(Correction, PriorMeansDoNotReplaceSoilNumbersThatPredictAnotherChannelBetter) {
  const CalibratedRecording calibrated(recorded(with_a_pull_beyond_any_soil()));
  const Correction refused =
      correction_by(calibrated, calibrated.base(), {}, calibrated.held_out({}, 2), 2);
  EXPECT_NE(refused.refused, "");
  for (const ChannelFit& fit : refused.proof.fit) {
    EXPECT_LE(fit.corrected_rmse, fit.calibrated_rmse * (1 + 1e-9)) << name(fit.channel);
  }
}

}  // namespace
}  // namespace regoplan
