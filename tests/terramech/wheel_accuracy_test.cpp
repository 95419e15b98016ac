// The direct model against adaptive quadrature and a bracketing root finder that share no code with
// it, over the whole domain.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/terramech/wheel_reference.h"
#include "tests/terramech/wheel_specs.h"

namespace regoplan {
namespace {

struct Condition {
  double load_n, slip, beta_rad;
};

double largest_load_n(const WheelModel& model, const WheelMotion& motion) {
  double low = 1e-6, high = 1e9;
  for (int i = 0; i < 40; ++i) {
    const double middle = std::sqrt(low * high);
    (has_forces(model.forces(middle, motion).status) ? low : high) = middle;
  }
  return low;
}

/// Loads of 2 to 300 % of nominal, uniform in their logarithm, and every third of half to 95 % of
/// the largest load that is carried; a quarter of the conditions uniform in slip and slip angle,
/// the others close to a locked wheel, to free rolling, to +-90 deg.
std::vector<Condition> conditions(const WheelModel& model, double nominal_load_n, int count) {
  std::mt19937_64 random(20040);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Condition> result;
  for (int i = 0; i < count; ++i) {
    Condition at{.load_n = nominal_load_n * 0.02 * std::pow(150, uniform(random)),
                 .slip = 2 * uniform(random) - 1,
                 .beta_rad = (2 * uniform(random) - 1) * std::numbers::pi / 2};
    const double close = std::pow(10, -5 * uniform(random));
    if (i % 4 == 1) at.slip = close - 1;
    if (i % 4 == 2) at.slip = std::copysign(close, at.slip);
    if (i % 4 == 3) at.beta_rad = std::copysign(std::numbers::pi / 2 - close, at.beta_rad);
    const double largest_n = largest_load_n(model, motion_at(at.slip, at.beta_rad));
    constexpr double kLargestShare = 0.95;
    if (i % 3 == 0) at.load_n = largest_n * (0.5 + (kLargestShare - 0.5) * uniform(random));
    if (at.load_n > kLargestShare * largest_n && at.load_n < largest_n) continue;
    result.push_back(at);
  }
  return result;
}

/// Another soil for the same wheel, its numbers some prior standard deviations off.
WheelModelSpec on_other_soil(WheelModelSpec spec) {
  spec.soil.kc *= 3;
  spec.soil.kphi *= 3;
  spec.soil.n = spec.soil.n > 1 ? spec.soil.n / 1.2 : spec.soil.n * 1.2;
  spec.soil.kx0_m *= 2;
  spec.soil.cohesion_pa *= 0.5;
  spec.soil.friction_angle_rad *= 0.9;
  return spec;
}

enum class Start { kOwnTable, kOtherSoil };

void expect_within(WheelAccuracy accuracy, double bound, Start start = Start::kOwnTable) {
  for (const auto& [name, spec, nominal_load_n] : wheel_specs::all()) {
    const WheelModel model = start == Start::kOwnTable
                                 ? WheelModel(spec, accuracy)
                                 : WheelModel(spec, accuracy, WheelModel(on_other_soil(spec)));
    const wheel_reference::Reference reference(spec, 1e-8);
    for (const Condition& at : conditions(model, nominal_load_n, 600)) {
      constexpr double kNearlyLocked = -0.98;
      if (start == Start::kOtherSoil && at.slip < kNearlyLocked) continue;
      const auto expected = reference.forces(at.load_n, at.slip, at.beta_rad);
      const WheelForces forces = model.forces(at.load_n, motion_at(at.slip, at.beta_rad));
      const std::string where = name + " load " + std::to_string(at.load_n) + " slip " +
                                std::to_string(at.slip) + " angle " + std::to_string(at.beta_rad);
      ASSERT_EQ(has_forces(forces.status), expected.carried) << where;
      if (!expected.carried) continue;
      const double allowed = bound * at.load_n;
      EXPECT_NEAR(forces.fx_n, expected.fx_n, allowed) << where;
      EXPECT_NEAR(forces.fy_n, expected.fy_n, allowed) << where;
      EXPECT_NEAR(forces.torque_nm, expected.torque_nm, allowed * spec.wheel.radius_m) << where;
    }
  }
}

}  // namespace

TEST(WheelAccuracy, ExactIsWithinThreeMillionthsOfTheLoad) {
  expect_within(WheelAccuracy::kExact, 3e-6);
}

TEST(WheelAccuracy, FastIsWithinOneAndAHalfTenThousandthsOfTheLoad) {
  expect_within(WheelAccuracy::kFast, 1.5e-4);
}

TEST(WheelAccuracy, StandsWhereverSinkagesAreSoughtFrom) {
  expect_within(WheelAccuracy::kFast, 1.5e-4, Start::kOtherSoil);
}

}  // namespace regoplan
