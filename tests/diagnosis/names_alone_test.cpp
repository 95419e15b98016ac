// What names explain by themselves, of mismatches that are far more than any of them.
#include "diagnosis/names/names_alone.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "diagnosis/fit/effect_list.h"
#include "synthetic_bed.h"

namespace regoplan {
namespace {

/// A recording calibrated, and the mechanisms that are tried of it.
struct Tried {
  explicit Tried(const TrueWheel& truth) : setup(simulant_setup()) {
    const Recording recording = record(truth, setup, setup.soil.mean, {.conditions = 32}, 3);
    calibrated = std::make_unique<CalibratedRecording>(recording, setup);
    effects = effects_for(calibrated->bed(), recording, EffectsOf::kPart);
  }
  DiagnosisSetup setup;
  std::unique_ptr<CalibratedRecording> calibrated;
  std::vector<Effect> effects;
};

/// The rut deepens with the speed at which the rim slides, whatever way; forces are off in a way of
/// their own.
TrueWheel sliding() {
  TrueWheel wheel;
  wheel.sinkage = [](const WheelRun& run, double h0) {
    const double slide = std::hypot(run.slip_ratio, std::sin(run.slip_angle_rad));
    return h0 * (1 + 2.0 * std::pow(slide, 1.7));
  };
  wheel.fx_n = [](const WheelRun& run, double) { return 3 * std::cos(6 * run.slip_ratio); };
  return wheel;
}

/// Far more than noise, and like no mechanism.
TrueWheel nameless() {
  TrueWheel wheel;
  wheel.fx_n = [](const WheelRun& run, double) {
    return 6 * std::sin(9 * run.slip_ratio + 20 * run.slip_angle_rad);
  };
  wheel.fy_n = [](const WheelRun& run, double) { return 5 * std::cos(11 * run.slip_ratio); };
  return wheel;
}

TEST(NamesAlone, TheNameThatIsAtWorkExplainsMostHoweverConditionsAreHeldOut) {
  const Tried tried(sliding());
  const auto names = names_alone(*tried.calibrated, tried.effects, nullptr, 0.02, 2);
  ASSERT_FALSE(names.empty());
  EXPECT_EQ(names.front().id, "sliding_sinkage");
  EXPECT_GT(names.front().share.share.low, 1.0 / 3.0);
  for (const NameAlone& name : names) EXPECT_FALSE(is_instrument(name.id));
}

TEST(NamesAlone, SayNoClassOfWhatIsLikeNoMechanism) {
  const Tried tried(nameless());
  EXPECT_FALSE(claim_by_shares(*tried.calibrated, tried.effects, 2));
}

TEST(NamesAlone, AreNotThereForFewThatDoNothing) {
  const Tried tried({});
  for (const NameAlone& name : names_alone(*tried.calibrated, tried.effects, nullptr, 0.5, 2)) {
    EXPECT_GT(name.share.gain_in_errors, 2) << name.id;
  }
  EXPECT_FALSE(claim_by_shares(*tried.calibrated, tried.effects, 2));
}

}  // namespace
}  // namespace regoplan
