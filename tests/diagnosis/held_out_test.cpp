#include "diagnosis/held_out.h"

#include <gtest/gtest.h>

#include "diagnosis/calibration.h"
#include "synthetic_bed.h"

namespace regoplan {
namespace {

struct Base {
  CondensedRecording recording;
  std::vector<SoilCoordinate> soil;
  CandidateFit fit;
};

Base base(const TrueWheel& truth) {
  const DiagnosisSetup setup = simulant_setup();
  Base made{condense(record(truth, setup, setup.soil.mean, {}, 1), setup),
            soil_coordinates(setup.soil),
            {}};
  const Calibration found = calibrate(made.recording.bed, made.soil);
  made.fit.x = found.x;
  made.fit.prediction = found.prediction;
  made.fit.jacobian = found.jacobian;
  made.fit.evidence.settings.assign(made.recording.bed.channels.size(), 0);
  return made;
}

TEST(HeldOut, AConditionsOwnFamilyHasNoPartInItsPrediction) {
  Base made = base({});
  const Families families = families_of(made.recording.bed);
  const HeldOut before = hold_out(made.recording, made.soil, made.fit, {}, families, 1);
  ChannelData& fx = made.recording.bed.channels.front();
  for (std::size_t i = 0; i < fx.conditions.size(); ++i) {
    if (families.of_condition[fx.conditions[i]] == 1) fx.mean[static_cast<Eigen::Index>(i)] += 30;
  }
  const HeldOut after = hold_out(made.recording, made.soil, made.fit, {}, families, 1);
  for (std::size_t i = 0; i < fx.conditions.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    if (families.of_condition[fx.conditions[i]] == 1) {
      EXPECT_DOUBLE_EQ(before.calibrated[row], after.calibrated[row]);
    }
  }
  EXPECT_GT((before.calibrated - after.calibrated).norm(), 0.1);
}

TEST(HeldOut, TheCalibratedModelReachesTheNoiseWhereNothingIsMissing) {
  const Base made = base({});
  const HeldOut out =
      hold_out(made.recording, made.soil, made.fit, {}, families_of(made.recording.bed), 2);
  for (const ChannelFit& fit : out.fit) {
    EXPECT_LT(fit.calibrated_rmse, 1.3 * fit.noise_floor) << name(fit.channel);
  }
}

TEST(HeldOut, FamiliesAreSlipAnglesWhereThereAreFour) {
  const Base made = base({});
  const Families families = families_of(made.recording.bed);
  EXPECT_EQ(families.by, "slip angle");
  EXPECT_EQ(families.count, 4);
}

}  // namespace
}  // namespace regoplan
