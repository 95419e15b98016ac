#include "diagnosis/names/correction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
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

/// Soft ground a few millimetres down, which bearing numbers far from their tests do as well.
TEST(Correction, WhatIsClaimedIsHandedOnWhereOnlySoilFarFromItsTestsDoesWithout) {
  TrueWheel truth;
  truth.depth_stiffness = [](double h) { return h < 0.004 ? 1 : 1 - 0.6 * (1 - 0.004 / h); };
  DiagnosisSetup setup = simulant_setup();
  for (const SoilParameter& p : soil_parameters()) setup.soil.standard_deviation.*p.member /= 2;
  const Diagnosis found = diagnose(record(truth, setup, setup.soil.mean, {}, 3), setup);
  ASSERT_TRUE(std::ranges::any_of(found.notes, [](const std::string& note) {
    return note.starts_with("calibrated soil numbers alone lie") &&
           note.find("from their tests") != std::string::npos;
  })) << found.sentence;
  ASSERT_EQ(found.corrected_model.mechanisms.size(), 1u);
  EXPECT_EQ(found.claims.front().id, "layered_soil");
  for (const SoilPull& soil : found.soil) EXPECT_LT(std::abs(soil.corrected_pull), 4.5);
}

}  // namespace
}  // namespace regoplan
