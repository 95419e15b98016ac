#include "planner/problem/rejection_text.h"

#include <gtest/gtest.h>

#include <optional>

#include "flat_problem.h"
#include "planner/plan.h"

namespace regoplan {
namespace {

TEST(RejectionText, SaysAnglesInDegreesWithTheUnit) {
  EXPECT_EQ(rejection_text(
                {.reason = Rejection::kSlope,
                 .x_m = 12,
                 .y_m = 3.5,
                 .exceeded = Exceeded{.found = 31.2 * kTestDegree, .limit = 25 * kTestDegree}}),
            "slope 31.2 deg (allowed: at most 25 deg) at (12.00, 3.50)");
  EXPECT_EQ(rejection_text(Rejection::kSlipAngle, Exceeded{-17 * kTestDegree, 16 * kTestDegree}),
            "slip angle -17 deg (allowed: at most 16 deg either way)");
}

TEST(RejectionText, SaysTheUnitOfEachNumber) {
  EXPECT_EQ(rejection_text(Rejection::kSinkage, Exceeded{0.12, 0.1}),
            "sinkage 0.12 m (allowed: at most 0.1 m)");
  EXPECT_EQ(rejection_text(Rejection::kSpeed, Exceeded{3.2, 3}),
            "speed 3.2 m/s (allowed: at most 3 m/s)");
  EXPECT_EQ(rejection_text(Rejection::kSlip, Exceeded{0.7, 0.6}),
            "slip 0.7 (allowed: at most 0.6)");
  EXPECT_EQ(rejection_text(Rejection::kSteering, Exceeded{0.4, 0.2}),
            "steering 0.4 1/m (allowed: at most 0.2 1/m)");
  EXPECT_EQ(rejection_text(Rejection::kTipOver, Exceeded{0.01, 0.05}),
            "tip over margin 0.01 (allowed: at least 0.05)");
}

TEST(RejectionText, ANumberBeyondItsLimitNeverLooksEqualToIt) {
  EXPECT_EQ(rejection_text(Rejection::kSlip, Exceeded{0.600001, 0.6}),
            "slip 0.600001 (allowed: at most 0.6)");
}

TEST(RejectionText, WithoutANumberOnlyTheReasonIsTold) {
  EXPECT_EQ(rejection_text({.reason = Rejection::kUnknownTerrain, .x_m = 1, .y_m = 2}),
            "unknown terrain at (1.00, 2.00)");
  EXPECT_EQ(rejection_text(Rejection::kCornering, std::nullopt), "cornering (no steady trim)");
}

TEST(RejectionText, AStartThatIsTooSteepIsRefusedInDegrees) {
  const double slope = std::tan(30 * kTestDegree);
  PlanningProblem problem = lrv_problem(one_soil_map(
      50, firm_regolith(), [slope](double x_m, double /*y_m*/) { return slope * x_m; }));
  problem.limits.slope_max_rad = 20 * kTestDegree;
  const PlanResult result = plan(problem);
  ASSERT_TRUE(result.certificate);
  EXPECT_NE(result.certificate->find("slope 30 deg (allowed: at most 20 deg)"), std::string::npos)
      << *result.certificate;
}

TEST(Plan, ARefusedStartSaysWhatRefusesItAndLooksForNothingElse) {
  const double slope = std::tan(12 * kTestDegree);
  PlanningProblem problem = lrv_problem(one_soil_map(
      50, firm_regolith(), [slope](double /*x_m*/, double y_m) { return slope * y_m; }));
  problem.goal.x_m = 20;
  problem.limits.slope_max_rad = 10 * kTestDegree;  // a search at 15 deg would find a path
  const PlanResult result = plan(problem);
  EXPECT_EQ(result.status, PlanStatus::kInfeasible);
  EXPECT_EQ(result.reason,
            "the vehicle may not stand at its start: slope 12 deg (allowed: at most 10 deg) at "
            "(10.00, 25.00)");
  EXPECT_EQ(result.certificate, result.reason);
}

}  // namespace
}  // namespace regoplan
