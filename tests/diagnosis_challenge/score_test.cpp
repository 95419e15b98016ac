#include "benchmarks/diagnosis/score.h"

#include <gtest/gtest.h>

namespace regoplan::challenge {
namespace {

Truth truth_of(const std::vector<std::string>& ids) {
  Truth truth{.stratum = Stratum::kOneEffect};
  for (const std::string& id : ids) truth.causes.push_back({.id = id, .accepted = {id}});
  return truth;
}

Outcome saying(const std::string& verdict, const std::vector<std::vector<std::string>>& classes) {
  Outcome outcome{.verdict = verdict, .rows = 50};
  for (const auto& ids : classes) outcome.claims.push_back({.ids = ids, .probability = 0.95});
  return outcome;
}

TEST(Score, SilenceIsNeitherRightNorAWrongName) {
  for (const std::string verdict : {"consistent", "parameters"}) {
    const Score s = score(truth_of({"grousers"}), saying(verdict, {}));
    EXPECT_TRUE(s.silent);
    EXPECT_FALSE(s.right || s.wrong_name || s.unexplained);
  }
}

TEST(Score, AnythingElseIsNotSilence) {
  for (const std::string verdict : {"named", "class", "unexplained", "failed"}) {
    EXPECT_FALSE(score({}, saying(verdict, {})).silent) << verdict;
  }
}

TEST(Score, TimeOrderAndPlaceAreTheCourseAndSlipIsNot) {
  Outcome outcome = saying("unexplained", {});
  outcome.located_in = {"slip_ratio", "load_n"};
  EXPECT_FALSE(score({}, outcome).located_in_course);
  for (const std::string column : {"time_s", "day", "on_day", "run_order", "position_m"}) {
    outcome.located_in = {"slip_ratio", column};
    EXPECT_TRUE(score({}, outcome).located_in_course) << column;
  }
}

TEST(Score, TheNameAloneIsExactAndAClassIsRight) {
  const Score name = score(truth_of({"grousers"}), saying("named", {{"grousers"}}));
  EXPECT_TRUE(name.right && name.exact);
  const Score one = score(truth_of({"grousers"}), saying("class", {{"slip_sinkage", "grousers"}}));
  EXPECT_TRUE(one.right);
  EXPECT_FALSE(one.exact);
}

TEST(Score, AFurtherWrongNameSpoilsARightOne) {
  const Score s = score(truth_of({"grousers"}), saying("named", {{"grousers"}, {"layered_soil"}}));
  EXPECT_TRUE(s.all_causes && s.wrong_name);
  EXPECT_FALSE(s.right);
}

TEST(Score, TwoEffectsNeedTwoClaims) {
  const Truth truth = truth_of({"grousers", "layered_soil"});
  EXPECT_FALSE(score(truth, saying("class", {{"grousers", "layered_soil"}})).all_causes);
  EXPECT_TRUE(score(truth, saying("named", {{"layered_soil"}, {"grousers"}})).right);
}

TEST(Score, TheSameNameTwiceIsRightOnce) {
  const Score s = score(truth_of({"grousers"}), saying("named", {{"grousers"}, {"grousers"}}));
  ASSERT_EQ(s.claims.size(), 2);
  EXPECT_TRUE(s.claims[0].right);
  EXPECT_FALSE(s.claims[1].right);
}

TEST(Score, AnInstrumentsFaultUnderAMechanismsNameIsCalledPhysics) {
  const Truth truth = truth_of({"sensor_bias"});
  EXPECT_TRUE(score(truth, saying("named", {{"bearing_drag"}})).called_physics);
  EXPECT_FALSE(score(truth, saying("class", {{"bearing_drag", "sensor_bias"}})).called_physics);
  EXPECT_FALSE(score(truth, saying("named", {{"sensor_gain"}})).called_physics);
  EXPECT_FALSE(score(truth, saying("unexplained", {})).called_physics);
}

TEST(Score, TheWorstChannelCounts) {
  Outcome outcome = saying("named", {{"grousers"}});
  outcome.fit = {{"fx_n", 1, 4, 1.1}, {"fy_n", 2, 3, 3.2}};
  const Score s = score(truth_of({"grousers"}), outcome);
  EXPECT_DOUBLE_EQ(s.corrected_ratio, 1.6);
  EXPECT_DOUBLE_EQ(s.calibrated_ratio, 4);
  EXPECT_FALSE(s.worse_than_calibrated);  // 3.2 against 3 with a standard error of .3
  outcome.fit[1].corrected_rmse = 3.7;
  EXPECT_TRUE(score(truth_of({"grousers"}), outcome).worse_than_calibrated);
}

// Wilson 1927; Brown, Cai & DasGupta 2001.
TEST(Wilson, KeepsToPublishedValues) {
  const auto none = wilson(0, 10);
  EXPECT_NEAR(none[0], 0, 1e-12);
  EXPECT_NEAR(none[1], 0.2775, 1e-4);
  const auto half = wilson(5, 10);
  EXPECT_NEAR(half[0], 0.2366, 1e-4);
  EXPECT_NEAR(half[1], 0.7634, 1e-4);
  EXPECT_EQ(wilson(0, 0)[1], 1);
}

}  // namespace
}  // namespace regoplan::challenge
