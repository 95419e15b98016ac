// What names explain by themselves, of mismatches that are far more than any of them.
#include "diagnosis/names/names_alone.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tried_names.h"

namespace regoplan {
namespace {

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

TEST(NamesAlone, TheNameThatIsAtWorkExplainsMostHoweverConditionsAreHeldOut) {
  const TriedNames tried(sliding());
  const auto names = names_alone(*tried.calibrated, tried.effects, nullptr, 0.02, 2);
  ASSERT_FALSE(names.empty());
  EXPECT_EQ(names.front().id, "sliding_sinkage");
  EXPECT_GT(names.front().share.share.low, 1.0 / 3.0);
  for (const NameAlone& name : names) EXPECT_FALSE(is_instrument(name.id));
}

TEST(NamesAlone, EachIsToldByOneFormAndReachesWhatItsBestFormDoes) {
  const TriedNames tried(sliding());
  const auto names = names_alone(*tried.calibrated, tried.effects, nullptr, 0.02, 2);
  std::set<std::string> ids;
  for (const NameAlone& name : names) {
    EXPECT_TRUE(ids.insert(name.id).second) << name.id;
    EXPECT_GE(name.reach, name.share.share.high);
  }
}

/// What a name does is its own, whatever remainder it was fitted beside.
TEST(NameShare, IsThatOfTheNameFittedWithNothingBesideIt) {
  const TriedNames tried(sliding());
  const CalibratedRecording& calibrated = *tried.calibrated;
  const auto sinkage = std::ranges::find(tried.effects, "sliding_sinkage", &Effect::id);
  ASSERT_NE(sinkage, tried.effects.end());
  const FitProblem problem = calibrated.problem();
  const Hypothesis name{{*sinkage}};
  const auto beside = [&](std::size_t setting) {
    const std::vector<std::size_t> settings(calibrated.bed().channels.size(), setting);
    return fit_under(problem, name, settings, start_of(problem, name, nullptr), 12, 0).value();
  };
  const CandidateFit large = beside(discrepancy_settings().size() - 1), none = beside(0);
  const auto share = [&](const CandidateFit& fit) {
    return name_share(calibrated, fitted_alone(calibrated, fit), 2).share.explained;
  };
  EXPECT_NEAR(share(large), share(none), 1e-3);
  EXPECT_GT(share(none), 1.0 / 3.0);
}

TEST(NamesAlone, AreNotThereForFewThatDoNothing) {
  const TriedNames tried({});
  for (const NameAlone& name : names_alone(*tried.calibrated, tried.effects, nullptr, 0.5, 2)) {
    EXPECT_GT(name.share.gain_in_errors, 2) << name.id;
  }
}

}  // namespace
}  // namespace regoplan
