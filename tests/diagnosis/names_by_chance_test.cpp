#include "diagnosis/names/names_by_chance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/fit/effect_list.h"
#include "diagnosis/recording/thresholds.h"
#include "synthetic_bed.h"

namespace regoplan {
namespace {

/// What some law does is told more shortly by its name than as a surface, or as sinkages, without a
/// law; what has no law is not, though names take part of it.
TEST(NamesByChance, FallShortOfALawAndReachWhatHasNone) {
  const DiagnosisSetup setup = simulant_setup();
  const auto best = [&](const TrueWheel& wheel) {
    const Recording recording = record(wheel, setup, setup.soil.mean, {}, 5);
    const CalibratedRecording calibrated(condense(recording, setup));
    const CappedContest contest(calibrated);
    std::vector<Effect> effects = effects_for(calibrated.bed(), recording, EffectsOf::kRecording);
    std::erase_if(effects, [](const Effect& e) {
      return e.id != "slip_sinkage" && e.id != "lateral_digging" && e.id != "bearing_drag";
    });
    const std::vector<CappedName> names = contest.score(effects, nullptr, 1);
    const std::vector<double> worlds = nats_by_chance(calibrated, contest, names, 6, 1);
    EXPECT_TRUE(std::ranges::is_sorted(worlds));
    return chance_of(worlds, names.front().over_unexplained_nats);
  };
  TrueWheel digging, nameless, sinking;
  digging.sinkage = [](const WheelRun& run, double h) {
    return h * (1 + 1.2 * (1 - std::exp(-2 * std::max(run.slip_ratio, 0.0))));
  };
  nameless.torque_nm = [](const WheelRun& run, double) {
    return 0.5 * std::sin(8 * run.slip_ratio) * std::cos(9 * run.slip_angle_rad);
  };
  sinking.sinkage = [](const WheelRun& run, double h) {  // the forces follow it
    return h * std::exp(0.4 * std::sin(7 * run.slip_ratio) * std::cos(9 * run.slip_angle_rad));
  };
  EXPECT_LE(best(digging), Thresholds::kByChance_p);
  EXPECT_GT(best(nameless), Thresholds::kByChance_p);
  EXPECT_GT(best(sinking), Thresholds::kByChance_p);
}

TEST(ChanceOf, CountsWhatIsJudgedAmongTheDraws) {
  EXPECT_DOUBLE_EQ(chance_of({1, 2, 3}, 4), 0.25);
  EXPECT_DOUBLE_EQ(chance_of({1, 2, 3}, 2), 0.75);
  EXPECT_DOUBLE_EQ(chance_of({}, 2), 1);
}

}  // namespace
}  // namespace regoplan
