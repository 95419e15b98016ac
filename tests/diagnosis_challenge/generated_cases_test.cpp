#include <gtest/gtest.h>

// Generated cases that once were judged wrongly, each for a reason of its own.
#include <algorithm>

#include "benchmarks/diagnosis/challenge.h"
#include "diagnosis/diagnosis.h"

namespace regoplan::challenge {
namespace {

Diagnosis diagnosed(Stratum stratum, std::uint64_t index) {
  const Challenge made = generate(stratum, 20261122, index);
  return diagnose(made.recording, made.setup);
}

TEST(GeneratedCases, AnOffsetOfTheOnlyDayIsNoFault) {
  const Diagnosis found = diagnosed(Stratum::kNulls, 97);
  EXPECT_EQ(found.verdict, Verdict::kParameters) << found.sentence;
  EXPECT_FALSE(found.smallest_detectable.empty());
}

TEST(GeneratedCases, ALackOfFitThatPredictsNothingIsTakenForChance) {
  const Diagnosis found = diagnosed(Stratum::kNulls, 89);
  EXPECT_LT(found.before.p_value, 0.005);
  EXPECT_EQ(found.verdict, Verdict::kParameters) << found.sentence;
  EXPECT_TRUE(std::ranges::any_of(found.notes, [](const std::string& note) {
    return note.find("taken for chance") != std::string::npos;
  }));
}

TEST(GeneratedCases, FaultsThatAreKnownExactlyMustLeaveNoLackOfFit) {
  const Diagnosis found = diagnosed(Stratum::kUnlisted, 14);
  EXPECT_EQ(found.verdict, Verdict::kUnexplained) << found.sentence;
}

}  // namespace
}  // namespace regoplan::challenge
