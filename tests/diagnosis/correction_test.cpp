#include "diagnosis/names/correction.h"

#include <gtest/gtest.h>

#include "synthetic_bed.h"

namespace regoplan {
namespace {

Correction corrected(const TrueWheel& truth) {
  const DiagnosisSetup setup = simulant_setup();
  const Recording recording = record(truth, setup, setup.soil.mean, {.outliers = 0}, 3);
  return calibrated_alone(CalibratedRecording(condense(recording, setup)), 2);
}

TEST(Correction, CalibratedSoilIsHandedOnWhereTheModelHolds) {
  const Correction correction = corrected({});
  EXPECT_EQ(correction.refused, "");
}

TEST(Correction, SoilNumbersThatPredictAChannelWorseThanThePriorMeansAreNotHandedOn) {
  // A pull that no soil gives: numbers that come near to it spoil the side force.
  TrueWheel truth;
  truth.fx_n = [](const WheelRun& run, double) { return 25 * std::max(run.slip_ratio, 0.0); };
  const Correction correction = corrected(truth);
  EXPECT_NE(correction.refused.find("the soil stays at its prior means"), std::string::npos)
      << correction.refused;
  EXPECT_EQ(correction.soil.mean.cohesion_pa, simulant_setup().soil.mean.cohesion_pa);
  EXPECT_EQ(correction.soil.mean.friction_angle_rad, simulant_setup().soil.mean.friction_angle_rad);
}

}  // namespace
}  // namespace regoplan
