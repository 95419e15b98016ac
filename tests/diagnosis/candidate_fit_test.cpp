// How names are fitted: across kinks, and to mismatches far above the noise.
#include "diagnosis/fit/candidate_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "calibrated_bed.h"
#include "diagnosis/fit/effect_list.h"

namespace regoplan {
namespace {

CalibratedBed bed_of(const TrueWheel& truth) {
  const DiagnosisSetup setup = simulant_setup();
  return CalibratedBed(record(truth, setup, setup.soil.mean, {.conditions = 32}, 2));
}

/// Like no mechanism, and far more than noise.
TrueWheel rippled() {
  TrueWheel wheel;
  wheel.fx_n = [](const WheelRun& run, double) { return 8 * std::sin(12 * run.slip_ratio); };
  return wheel;
}

double pulls_of(const CalibratedBed& made, const CandidateFit& fit) {
  return fit.x.head(static_cast<Eigen::Index>(made.soil.size())).norm();
}

/// Friction of the rim is the soil's where it would be more: there it does nothing, and says
/// nothing of where it would.
TEST(CandidateFit, ANameThatMayDoNothingFitsNoWorseThanNone) {
  const CalibratedBed made = bed_of(rippled());
  const TestBed& bed = made.recording.bed;
  const std::vector<std::size_t> noise_only(bed.channels.size(), 0);
  const auto none = fit_under(made.problem(), {}, noise_only, start_of(made.problem(), {}), 30, 0);
  ASSERT_TRUE(none);
  for (const Effect& effect : effects_for(bed, {}, EffectsOf::kPart)) {
    if (effect.id != "rim_friction") continue;
    const Hypothesis name{.effects = {effect}};
    const auto fit =
        fit_under(made.problem(), name, noise_only, start_of(made.problem(), name), 30, 0);
    ASSERT_TRUE(fit) << effect.form;
    EXPECT_LT(variances_off(bed, fit->prediction) + fit->x.squaredNorm(),
              1.05 * (variances_off(bed, none->prediction) + none->x.squaredNorm()))
        << effect.form;
  }
}

TEST(CandidateFit, SoilNumbersStayNearTheirTestsWhereAMismatchIsFarMoreThanNoise) {
  const CalibratedBed made = bed_of(rippled());
  const auto wide =
      fit_to_widened(made.problem(), {}, deviations_off(made.recording.bed, made.fit.prediction),
                     start_of(made.problem(), {}), 12);
  ASSERT_TRUE(wide);
  EXPECT_LT(pulls_of(made, *wide), 0.7 * pulls_of(made, made.fit));
  EXPECT_GT(std::ranges::max(wide->widened), 2);
}

TEST(CandidateFit, NoiseIsNotWidenedWhereNothingIsLeft) {
  const CalibratedBed made = bed_of({});
  const auto wide =
      fit_to_widened(made.problem(), {}, deviations_off(made.recording.bed, made.fit.prediction),
                     start_of(made.problem(), {}), 12);
  ASSERT_TRUE(wide);
  EXPECT_LT(std::ranges::max(wide->widened), 1.2);
  EXPECT_NEAR(pulls_of(made, *wide), pulls_of(made, made.fit), 0.3);
}

}  // namespace
}  // namespace regoplan
