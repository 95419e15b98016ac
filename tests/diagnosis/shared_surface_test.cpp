// The surface through what references say of the base model's shortcomings.
#include "diagnosis/checks/shared_surface.h"

#include <gtest/gtest.h>

#include <vector>

namespace regoplan {
namespace {

Condition at_slip(double slip_ratio) {
  return {.load_n = 50, .slip_ratio = slip_ratio, .runs = {0}};
}

TEST(SharedSurface, ErrsBetweenPointsThatItMissesAndNotAtThem) {
  constexpr double kNoise_n = 1, kStep_n = 1000;  // more than any discrepancy is told to be
  std::vector<Condition> conditions;
  for (int i = 0; i < 31; ++i) conditions.push_back(at_slip(-0.3 + 0.03 * i));
  conditions.erase(conditions.begin() + 22, conditions.begin() + 25);
  const auto n = static_cast<Eigen::Index>(conditions.size());
  ShortcomingPoints points{.residual = Eigen::VectorXd::Zero(n),
                           .noise = kNoise_n * kNoise_n * Eigen::MatrixXd::Identity(n, n),
                           .scale = kNoise_n};
  for (const Condition& at : conditions) points.at.push_back(&at);
  points.residual.tail(7).setConstant(kStep_n);
  const Condition between = at_slip(0.39);
  const SharedSurface surface =
      surface_through(points, Channel::kFx, {points.at[4], points.at.back(), &between}, {});
  const Eigen::VectorXd deviation_n = surface.covariance.diagonal().cwiseSqrt();
  EXPECT_LT(deviation_n[0], 1.1 * kNoise_n);
  EXPECT_LT(deviation_n[1], 1.1 * kNoise_n);
  EXPECT_GT(deviation_n[2], 2 * kNoise_n);
}

}  // namespace
}  // namespace regoplan
