// A diagnosis from end to end that is small enough for a build with sanitizers.
#include <gtest/gtest.h>

#include "diagnosis/diagnosis.h"
#include "synthetic_bed.h"

namespace regoplan {
namespace {

/// Nine conditions at one load.
BedPlan small_plan() {
  BedPlan plan;
  plan.slips = {0, 0.3, 0.7};
  plan.angles_deg = {0, 8, 16};
  plan.loads_n = {64.7};
  plan.conditions = 9;
  return plan;
}

TEST(SmallRecording, GoesThroughEveryStageToANameWithItsPlaceAndCorrection) {
  TrueWheel digging;  // saturating: no form that the tool carries
  digging.sinkage = [](const WheelRun& run, double h) {
    return h * (1 + 0.8 * (1 - std::exp(-2.5 * std::max(run.slip_ratio, 0.0))));
  };
  const DiagnosisSetup setup = simulant_setup();
  const Diagnosis found = diagnose(record(digging, setup, setup.soil.mean, small_plan(), 4), setup);
  EXPECT_GT(found.before.f, found.before.critical);
  ASSERT_EQ(found.claims.size(), 1u) << found.sentence;
  EXPECT_EQ(found.claims.front().id, "slip_sinkage") << found.sentence;
  ASSERT_FALSE(found.where.empty());
  EXPECT_EQ(found.where.front().channel, Channel::kSinkage);
  for (const ChannelFit& fit : found.fit) {
    if (fit.channel != Channel::kSinkage) continue;
    EXPECT_LT(fit.corrected_rmse, fit.calibrated_rmse);
  }
  EXPECT_LT(found.after.f, found.before.f);
}

}  // namespace
}  // namespace regoplan
