#include <gtest/gtest.h>

// The integrator behind the challenges shares no code with the wheel model, and agrees with it
// where nothing is changed.
#include <cmath>

#include "benchmarks/diagnosis/truth_wheel.h"
#include "tests/terramech/wheel_specs.h"

namespace regoplan::challenge {
namespace {

TruthPhysics base_of(const WheelModelSpec& spec, double load_n, double slip, double beta_rad) {
  return {.variant = spec.variant,
          .wheel = spec.wheel,
          .soil = spec.soil,
          .gravity_mps2 = spec.gravity_mps2,
          .at = {.load_n = load_n, .slip_ratio = slip, .slip_angle_rad = beta_rad}};
}

void expect_agreement(const WheelModelSpec& spec, double load_n, double slip, double beta_rad) {
  const auto mine = truth_channels(base_of(spec, load_n, slip, beta_rad));
  const WheelForces model = WheelModel(spec).forces(load_n, motion_at(slip, beta_rad));
  ASSERT_EQ(mine.has_value(), has_forces(model.status)) << slip << ", " << beta_rad;
  if (!mine) return;
  const double little = 1e-4 * load_n;
  EXPECT_NEAR(mine->fx_n, model.fx_n, little) << slip << ", " << beta_rad;
  EXPECT_NEAR(mine->fy_n, model.fy_n, little) << slip << ", " << beta_rad;
  EXPECT_NEAR(mine->torque_nm, model.torque_nm, little * spec.wheel.radius_m)
      << slip << ", " << beta_rad;
  EXPECT_NEAR(mine->sinkage_m, model.sinkage_m, 1e-4 * model.sinkage_m) << slip << ", " << beta_rad;
}

TEST(TruthWheel, AgreesWithTheWheelModel) {
  for (const WheelModelSpec& spec :
       {wheel_specs::ishigami2007(), wheel_specs::yoshida2004(),
        wheel_specs::with_exponent(wheel_specs::ishigami2007(), 1.3, 3e6, 0.3),
        wheel_specs::with_exponent(wheel_specs::ishigami2007(), 0.8, 4e5, 0.6)}) {
    for (const double load_n : {20.0, 60.0}) {
      for (const double slip : {-0.6, -0.2, 0.0, 0.15, 0.4, 0.8}) {
        for (const double beta_deg : {-20.0, 0.0, 4.0, 16.0, 30.0}) {
          expect_agreement(spec, load_n, slip, beta_deg * kDegree);
        }
      }
    }
  }
}

TEST(TruthWheel, SaysSoWhereNoSinkageCarriesTheLoad) {
  EXPECT_FALSE(truth_channels(base_of(wheel_specs::ishigami2007(), 1e5, 0.2, 0)));
}

TEST(TruthWheel, ALevelRutHasEqualEdges) {
  const auto c = truth_channels(base_of(wheel_specs::ishigami2007(), 60, 0.2, 16 * kDegree));
  ASSERT_TRUE(c);
  EXPECT_EQ(c->rut_left_m, c->sinkage_m);
  EXPECT_EQ(c->rut_right_m, c->sinkage_m);
}

// For a motion to the left the turn's centre, and the deeper side, is on the right.
TEST(TruthWheel, TheInnerSideOfATiltedRutIsDeeper) {
  TruthPhysics p = base_of(wheel_specs::ishigami2007(), 60, 0.2, 16 * kDegree);
  p.rut = 0.5;
  const auto to_left = truth_channels(p);
  p.at.slip_angle_rad *= -1;
  const auto to_right = truth_channels(p);
  ASSERT_TRUE(to_left && to_right);
  EXPECT_GT(to_left->rut_right_m, 1.5 * to_left->rut_left_m);
  EXPECT_EQ(to_left->rut_right_m, to_right->rut_left_m);
  EXPECT_EQ(to_left->fy_n, -to_right->fy_n);
}

}  // namespace
}  // namespace regoplan::challenge
