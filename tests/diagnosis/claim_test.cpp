#include "diagnosis/names/claim.h"

#include <gtest/gtest.h>

#include "account_of.h"
#include "calibrated_bed.h"
#include "diagnosis/fit/effect_list.h"
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

/// Whether an effect is refused with one of its numbers so many deviations off.
bool is_too_far(const CalibratedBed& bed, const Effect& effect, Eigen::Index number,
                double deviations, double plausible_fault = Thresholds::kPlausibleFault) {
  CandidateFit fit = bed.fit;
  fit.candidate = {{effect}};
  const auto numbers = static_cast<Eigen::Index>(effect.coordinates.size());
  fit.x.conservativeResize(bed.fit.x.size() + numbers);
  fit.x.tail(numbers).setZero();
  fit.x[bed.fit.x.size() + number] = deviations;
  const std::string doubt = objection(bed.problem(), fit, plausible_fault);
  return doubt.find("far from what is usual") != std::string::npos;
}

TEST(Claim, AFaultOfAnInstrumentMayBeFartherFromWhatIsUsualThanPhysics) {
  static_assert(Thresholds::kPlausibleFault > Thresholds::kPlausible);
  const DiagnosisSetup setup = simulant_setup();
  const Recording recording = record({}, setup, setup.soil.mean, {}, 1);
  const CalibratedBed bed(recording, setup);
  int faults = 0, others = 0;
  for (const Effect& effect : effects_for(bed.recording.bed, recording)) {
    const bool is_fault = is_instrument(effect.id) && effect.course == FaultCourse::kConstant;
    ++(is_fault ? faults : others);
    const double bound = is_fault ? Thresholds::kPlausibleFault : Thresholds::kPlausible;
    for (Eigen::Index k = 0; k < static_cast<Eigen::Index>(effect.coordinates.size()); ++k) {
      for (const double side : {-1.0, 1.0}) {
        EXPECT_FALSE(is_too_far(bed, effect, k, side * (bound - 0.1))) << effect.id;
        EXPECT_TRUE(is_too_far(bed, effect, k, side * (bound + 0.1))) << effect.id;
        EXPECT_TRUE(is_too_far(bed, effect, k, side * (Thresholds::kPlausible + 0.1),
                               Thresholds::kPlausible))
            << effect.id;
      }
    }
  }
  EXPECT_GT(faults, 5);
  EXPECT_GT(others, 5);
}

}  // namespace
}  // namespace regoplan
