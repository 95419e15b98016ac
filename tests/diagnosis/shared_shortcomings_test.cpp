// What test and reference share of the base model's shortcomings is taken off the test.
#include "diagnosis/checks/shared_shortcomings.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "synthetic_bed.h"

namespace regoplan {
namespace {

CondensedRecording recorded(const TrueWheel& truth) {
  const DiagnosisSetup setup = simulant_setup();
  const BedPlan plan{.conditions = 30, .replicates = 2, .day = 0, .outliers = 0};
  return condense(record(truth, setup, setup.soil.mean, plan, 5), setup);
}

CondensedRecording with_a_smooth_shortcoming() {
  TrueWheel truth;
  truth.fx_n = [](const WheelRun& run, double) { return -14 * std::sin(3 * run.slip_ratio); };
  return recorded(truth);
}

/// What follows the order of its conditions, from 0 to 1.
void place_in_order_of_time(CondensedRecording& recording) {
  std::vector<Condition>& conditions = recording.bed.conditions;
  for (std::size_t k = 0; k < conditions.size(); ++k) {
    conditions[k].when = static_cast<double>(k) / static_cast<double>(conditions.size());
  }
}

TEST(SharedShortcomings, AreKnownWheneverTheReferenceWasRun) {
  const CondensedRecording test = with_a_smooth_shortcoming();
  CondensedRecording reference = test;
  const MeasuredTest before = difference_bed(test, {reference}, SharedBase::kPriorMeans).measured;
  place_in_order_of_time(reference);
  const MeasuredTest after = difference_bed(test, {reference}, SharedBase::kPriorMeans).measured;
  EXPECT_GT(before.shared.cwiseAbs().maxCoeff(), 5);
  EXPECT_EQ(before.shared, after.shared);
}

TEST(SharedShortcomings, LeaveWhatOneSeriesFollowsInItsCourseOutOfTheDifference) {
  const CondensedRecording reference = with_a_smooth_shortcoming();
  CondensedRecording test = reference;
  const std::size_t conditions = test.bed.conditions.size();
  Course course{.column = "run_order"};
  for (const std::size_t k : test.condition) course.value.push_back(2 * k < conditions ? 0 : 1);
  course.trend.assign(test.noise.size(), course.value);
  test.course = course;
  constexpr double kChange_n = 20;
  for (ChannelNoise& noise : test.noise) noise.trend = 0;
  test.noise.front().trend = kChange_n;
  const auto noise_of = [&](const CondensedRecording& one) {
    const DifferenceBed bed = difference_bed(one, {reference}, SharedBase::kPriorMeans);
    return Eigen::MatrixXd(bed.test.bed.channels.front().noise);
  };
  const Eigen::MatrixXd more = noise_of(test) - noise_of(reference);
  const Eigen::VectorXd eigenvalues =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(more).eigenvalues();
  const Eigen::Index last = eigenvalues.size() - 1;
  EXPECT_GT(eigenvalues[last], kChange_n * kChange_n);
  EXPECT_LT(eigenvalues.head(last).cwiseAbs().maxCoeff(), 1e-9 * eigenvalues[last]);
}

}  // namespace
}  // namespace regoplan
