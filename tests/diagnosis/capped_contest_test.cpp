#include "diagnosis/names/capped_contest.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "diagnosis/fit/effect_list.h"
#include "synthetic_bed.h"

namespace regoplan {
namespace {

/// Beside much noise a name that explains all there is explains little of the misfit: its own share
/// is told of the excess, by name_share(), and so must be what chance is held against. A nameless
/// misfit of one channel may be nearly the constant that some name adds there.
TEST(CappedContest, OfNamelessWorldsTellsSharesOfTheExcess) {
  const DiagnosisSetup setup = simulant_setup();
  TrueWheel pushing;
  pushing.torque_nm = [](const WheelRun&, double) { return 0.12; };
  const Recording recording = record(pushing, setup, setup.soil.mean, {}, 5);
  const CalibratedRecording calibrated(condense(recording, setup));
  const CappedContest contest(calibrated);
  const std::vector<CappedName> names =
      contest.score(effects_for(calibrated.bed(), recording, EffectsOf::kRecording), nullptr, 1);
  const std::vector<ByChance> worlds = contest.by_chance(names, 40, 6, 1);
  const double most = std::ranges::max_element(worlds, {}, &ByChance::share)->share;
  EXPECT_GT(most, 0.7);
  EXPECT_TRUE(std::ranges::is_sorted(worlds, {}, &ByChance::gain_nats));
}

}  // namespace
}  // namespace regoplan
