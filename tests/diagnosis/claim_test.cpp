#include "diagnosis/names/claim.h"

#include <gtest/gtest.h>

#include "account_of.h"
#include "calibrated_bed.h"
#include "diagnosis/recording/thresholds.h"

namespace regoplan {
namespace {

std::vector<ScoredId> scored(const std::vector<std::pair<std::string, double>>& probabilities) {
  std::vector<ScoredId> all;
  for (const auto& [id, probability] : probabilities) {
    all.push_back(
        {.account = account_of(id), .score = std::log(probability), .probability = probability});
  }
  return all;
}

TEST(Claim, OneNameThatIsSureIsNamed) {
  const auto claimed = claimed_names(scored({{"grousers", 0.95}, {"unexplained", 0.05}}));
  ASSERT_EQ(claimed.size(), 1);
  EXPECT_EQ(claimed[0].ids, std::vector<std::string>{"grousers"});
  EXPECT_DOUBLE_EQ(claimed[0].probability, 0.95);
}

TEST(Claim, NamesThatShareTheProbabilityAreAClass) {
  const auto claimed =
      claimed_names(scored({{"grousers", 0.5}, {"slip_sinkage", 0.45}, {"parameters", 0.05}}));
  ASSERT_EQ(claimed.size(), 1);
  EXPECT_EQ(claimed[0].ids, (std::vector<std::string>{"grousers", "slip_sinkage"}));
}

TEST(Claim, NothingIsClaimedWhereUnexplainedHoldsATenth) {
  EXPECT_TRUE(claimed_names(scored({{"grousers", 0.85}, {"unexplained", 0.15}})).empty());
}

TEST(Claim, NothingIsClaimedWhereFiveNamesCompete) {
  EXPECT_TRUE(claimed_names(scored({{"a", 0.22}, {"b", 0.2}, {"c", 0.2}, {"d", 0.2}, {"e", 0.18}}))
                  .empty());
}

TEST(Claim, TwoEffectsAreTwoClaims) {
  const auto claimed = claimed_names(scored({{"grousers+multi_pass", 0.97}, {"grousers", 0.03}}));
  ASSERT_EQ(claimed.size(), 2);
  EXPECT_EQ(claimed[0].ids, std::vector<std::string>{"grousers"});
  EXPECT_EQ(claimed[1].ids, std::vector<std::string>{"multi_pass"});
}

TEST(Claim, ASureEffectStandsAloneWhereItsPartnerIsNot) {
  const auto claimed = claimed_names(
      scored({{"grousers", 0.5}, {"grousers+multi_pass", 0.3}, {"grousers+rear_contact", 0.2}}));
  ASSERT_EQ(claimed.size(), 1);
  EXPECT_EQ(claimed[0].ids, std::vector<std::string>{"grousers"});
}

TEST(Claim, ASecondEffectThatIsLikelierThanNoneIsClaimedForHeldOutConditionsToTry) {
  const auto claimed = claimed_names(
      scored({{"grousers+multi_pass", 0.5}, {"grousers", 0.3}, {"grousers+rear_contact", 0.2}}));
  ASSERT_EQ(claimed.size(), 2);
  EXPECT_EQ(claimed[1].ids, (std::vector<std::string>{"multi_pass", "rear_contact"}));
  EXPECT_NEAR(claimed[1].probability, 0.7, 1e-12);
}

TEST(Claim, IsNotBelievedWithASoilNumberFarFromItsTests) {
  const DiagnosisSetup setup = simulant_setup();
  const CalibratedBed bed(record({}, setup, setup.soil.mean, {}, 1), setup);
  CandidateFit fit = bed.fit;
  EXPECT_EQ(objection(bed.problem(), fit), "");
  for (const double side : {-1.0, 1.0}) {
    fit.x[0] = side * (Thresholds::kSoilBack - 0.1);
    EXPECT_EQ(objection(bed.problem(), fit), "");
    fit.x[0] = side * (Thresholds::kSoilBack + 0.1);
    const std::string doubt = objection(bed.problem(), fit);
    EXPECT_NE(doubt.find(bed.soil[0].coordinate.name + " would still lie"), doubt.npos) << doubt;
  }
}

}  // namespace
}  // namespace regoplan
