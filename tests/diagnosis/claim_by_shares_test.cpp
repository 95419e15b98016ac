// Classes of names for what no single name explains.
#include "diagnosis/names/claim_by_shares.h"

#include <gtest/gtest.h>

#include <cmath>

#include "diagnosis/names/names_alone.h"
#include "diagnosis/recording/thresholds.h"
#include "tried_names.h"

namespace regoplan {
namespace {

/// Far more than noise, and like no mechanism.
TrueWheel nameless() {
  TrueWheel wheel;
  wheel.fx_n = [](const WheelRun& run, double) {
    return 6 * std::sin(9 * run.slip_ratio + 20 * run.slip_angle_rad);
  };
  wheel.fy_n = [](const WheelRun& run, double) { return 5 * std::cos(11 * run.slip_ratio); };
  return wheel;
}

/// The rut deepens with the slip angle; forces are off in ways of their own.
TrueWheel digging() {
  TrueWheel wheel;
  wheel.sinkage = [](const WheelRun& run, double h0) {
    return h0 * (1 + std::abs(run.slip_angle_rad));
  };
  wheel.fx_n = [](const WheelRun& run, double) { return 3 * std::cos(6 * run.slip_ratio); };
  wheel.fy_n = [](const WheelRun& run, double) {
    return 5 * std::sin(6 * run.slip_ratio + 3 * run.slip_angle_rad);
  };
  return wheel;
}

TEST(ClaimByShares, SaysNothingOfWhatIsLikeNoMechanism) {
  const TriedNames tried(nameless());
  EXPECT_FALSE(claim_by_shares(*tried.calibrated, tried.effects, 2));
}

TEST(ClaimByShares, SaysNothingWhereNothingIsMissing) {
  const TriedNames tried({});
  EXPECT_FALSE(claim_by_shares(*tried.calibrated, tried.effects, 2));
}

/// What explains most by itself moves a force the wrong way. Another of its class with what follows
/// does not, and the class still says what it may be.
TEST(ClaimByShares, NamesTogetherPredictNoChannelWorseThanNone) {
  const TriedNames tried(digging());
  const auto alone = names_alone(*tried.calibrated, tried.effects, nullptr, 0.02, 2);
  ASSERT_EQ(alone.front().id, "lateral_digging");
  ASSERT_TRUE(alone.front().share.worsens());
  const auto claim = claim_by_shares(*tried.calibrated, tried.effects, 2);
  ASSERT_TRUE(claim);
  EXPECT_TRUE(claim->claims.front().is_of("lateral_digging"));
  EXPECT_FALSE(name_share(*tried.calibrated, claim->fit, 2).worsens());
  for (const Claim& one : claim->claims) EXPECT_GE(one.share->low, Thresholds::kWorthAnother);
}

}  // namespace
}  // namespace regoplan
