#include "diagnosis/names/correction.h"

#include <gtest/gtest.h>

#include <string>

#include "synthetic_bed.h"

namespace regoplan {
namespace {

CondensedRecording recorded(const TrueWheel& truth) {
  const DiagnosisSetup setup = simulant_setup();
  return condense(record(truth, setup, setup.soil.mean, {.outliers = 0}, 3), setup);
}

Correction corrected(const TrueWheel& truth) {
  const CalibratedRecording calibrated(recorded(truth));
  return calibrated_alone(calibrated, calibrated.held_out({}, 2), 2);
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

TEST(Correction, TellsOfSoilNumbersThatPredictAChannelWorseThanThePriorMeans) {
  const CalibratedRecording pulled(recorded(with_a_pull_beyond_any_soil()));
  EXPECT_NE(worse_than_prior_means(pulled, pulled.held_out({}, 2)).find("predict fy_n worse"),
            std::string::npos);
  const CalibratedRecording sound(recorded({}));
  EXPECT_EQ(worse_than_prior_means(sound, sound.held_out({}, 2)), "");
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
