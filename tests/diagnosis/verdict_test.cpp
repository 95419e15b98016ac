// The verdict over names that are claimed.
#include <gtest/gtest.h>

#include "diagnosis/findings/findings.h"

namespace regoplan {
namespace {

Diagnosis of_claim(double explained, bool excess_is_clear) {
  return {.claims = {{.id = "slip_sinkage", .share = Share{.explained = explained}}},
          .excess_is_clear = excess_is_clear,
          .remainder_share = 1 - explained};
}

TEST(Verdict, OfNamesThatExplainMostIsNamedOrTheirClass) {
  Diagnosis diagnosis = of_claim(0.9, true);
  EXPECT_EQ(verdict_of_names(diagnosis), Verdict::kNamed);
  diagnosis.claims.front().equivalent = {"grousers"};
  EXPECT_EQ(verdict_of_names(diagnosis), Verdict::kClass);
}

TEST(Verdict, OfNamesThatLeaveMostWithoutANameIsPartly) {
  Diagnosis diagnosis = of_claim(0.15, true);
  EXPECT_EQ(verdict_of_names(diagnosis), Verdict::kPartly);
  diagnosis.claims.front().equivalent = {"grousers"};
  EXPECT_EQ(verdict_of_names(diagnosis), Verdict::kPartly);
}

TEST(Verdict, OfNamesIsNotPartlyWhereWhatTheyLeaveIsNoise) {
  EXPECT_EQ(verdict_of_names(of_claim(0.15, false)), Verdict::kNamed);
}

}  // namespace
}  // namespace regoplan
