// What the wheel model promises on every soil: symmetries, limits, answers at the edges, and the
// claims of the paper.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "terramech/basics/input_error.h"
#include "terramech/wheel/wheel_model.h"
#include "tests/terramech/wheel_specs.h"

namespace regoplan {
namespace {

using wheel_specs::NamedSpec;

const std::vector<double> kSlips{-1, -0.95, -0.6, -0.2, -0.01, 0, 0.01, 0.2, 0.6, 0.95, 1};

WheelForces at(const WheelModel& model, double load_n, double slip, double beta_deg) {
  return model.forces(load_n, motion_at(slip, beta_deg * kDegree));
}

class WheelLaws : public testing::TestWithParam<NamedSpec> {
 protected:
  WheelModel model{GetParam().spec};
  double load_n = GetParam().nominal_load_n;
};

std::string title(const testing::TestParamInfo<NamedSpec>& info) {
  std::string name = info.param.name;
  for (char& c : name) {
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  }
  return name;
}

TEST_P(WheelLaws, SideForceIsOddInTheSlipAngleAndTheRestIsEven) {
  for (const double slip : kSlips) {
    for (const double beta_deg : {0.01, 4.0, 30.0, 80.0, 90.0}) {
      const WheelForces left = at(model, load_n, slip, beta_deg);
      const WheelForces right = at(model, load_n, slip, -beta_deg);
      EXPECT_EQ(left.fy_n, -right.fy_n);
      EXPECT_EQ(left.fx_n, right.fx_n);
      EXPECT_EQ(left.torque_nm, right.torque_nm);
      EXPECT_EQ(left.sinkage_m, right.sinkage_m);
    }
  }
}

TEST_P(WheelLaws, NoSideForceWithoutSlipAngle) {
  for (const double slip : kSlips) EXPECT_EQ(at(model, load_n, slip, 0).fy_n, 0) << slip;
}

TEST_P(WheelLaws, SideForceOpposesLateralMotionHoweverSmall) {
  for (const double slip : {-0.6, 0.0, 0.6}) {
    double before = 0;
    for (const double beta_deg : {1e-9, 1e-6, 1e-3, 1.0, 20.0}) {
      const double fy = at(model, load_n, slip, beta_deg).fy_n;
      EXPECT_GT(fy, before) << slip << " " << beta_deg;
      before = fy;
    }
  }
}

TEST_P(WheelLaws, SideForceVanishesWhenTheWheelSpinsOnTheSpot) {
  EXPECT_NEAR(at(model, load_n, 1, 45).fy_n, 0, 1e-9 * load_n);
  double before = std::numeric_limits<double>::infinity();
  for (const double slip : {0.6, 0.9, 0.99, 0.9999, 0.9999999}) {
    const WheelForces forces = at(model, load_n, slip, 20);
    if (!has_forces(forces.status)) continue;
    EXPECT_LT(forces.fy_n, before);
    before = forces.fy_n;
  }
  EXPECT_LT(before, 1e-3 * load_n);
}

TEST_P(WheelLaws, ForcesDependOnVelocityRatiosOnly) {
  for (const double slip : {-0.7, 0.0, 0.4}) {
    const WheelMotion slow = motion_at(slip, 0.3);
    const WheelMotion fast{64 * slow.vx_mps, 64 * slow.vy_mps, 64 * slow.rim_speed_mps};
    EXPECT_EQ(model.forces(load_n, slow).fx_n, model.forces(load_n, fast).fx_n);
    EXPECT_EQ(model.forces(load_n, slow).fy_n, model.forces(load_n, fast).fy_n);
  }
}

TEST_P(WheelLaws, ReverseIsTheMirrorImageOfForward) {
  for (const double slip : {-1.0, -0.7, 0.0, 0.4}) {
    const WheelMotion forward = motion_at(slip, 0.3);
    const WheelMotion reverse{-forward.vx_mps, forward.vy_mps, -forward.rim_speed_mps};
    const WheelForces a = model.forces(load_n, forward), b = model.forces(load_n, reverse);
    EXPECT_EQ(a.fx_n, -b.fx_n);
    EXPECT_EQ(a.torque_nm, -b.torque_nm);
    EXPECT_EQ(a.fy_n, b.fy_n);
    EXPECT_EQ(a.sinkage_m, b.sinkage_m);
  }
}

TEST_P(WheelLaws, TheLockedWheelIsTheLimitOfHardBraking) {
  for (const double beta : {0.0, 0.3}) {
    const WheelForces locked = model.forces(load_n, {1, std::tan(beta), 0});
    const WheelForces nearly = model.forces(load_n, {1, std::tan(beta), 1e-9});
    ASSERT_EQ(has_forces(locked.status), has_forces(nearly.status));
    EXPECT_NEAR(locked.fx_n, nearly.fx_n, 1e-5 * load_n);
    EXPECT_NEAR(locked.fy_n, nearly.fy_n, 1e-5 * load_n);
    EXPECT_NEAR(locked.torque_nm, nearly.torque_nm, 1e-5 * load_n);
  }
}

TEST_P(WheelLaws, ForcesAreContinuousThroughFreeRolling) {
  const WheelForces zero = at(model, load_n, 0, 10);
  for (const double slip : {-1e-7, 1e-7}) {
    EXPECT_NEAR(at(model, load_n, slip, 10).fx_n, zero.fx_n, 1e-4 * load_n);
    EXPECT_NEAR(at(model, load_n, slip, 10).fy_n, zero.fy_n, 1e-4 * load_n);
  }
}

TEST_P(WheelLaws, TheContactCarriesTheLoadItIsGiven) {
  const double radius_m = GetParam().spec.wheel.radius_m;
  double before = 0;
  for (const double share : {1e-4, 0.02, 0.3, 1.0, 2.0}) {
    const WheelForces forces = at(model, share * load_n, 0.2, 5);
    ASSERT_EQ(forces.status, share < 1e-2 && !has_forces(forces.status)
                                 ? WheelStatus::kCohesionCarriesLoad
                                 : WheelStatus::kOk);
    if (!has_forces(forces.status)) continue;
    EXPECT_GT(forces.sinkage_m, before);
    EXPECT_LT(forces.sinkage_m, radius_m);
    EXPECT_NEAR(forces.sinkage_m, radius_m * (1 - std::cos(forces.theta_f_rad)), 1e-12);
    EXPECT_LE(forces.theta_r_rad, 0);
    before = forces.sinkage_m;
  }
}

TEST_P(WheelLaws, ALoadThatNothingCarriesIsAnAnswer) {
  for (const double slip : {-0.5, 0.0, 0.5}) {
    const WheelForces forces = at(model, 1e9, slip, 5);
    EXPECT_EQ(forces.status, WheelStatus::kSinksToAxle);
    EXPECT_FALSE(has_forces(forces.status));
    EXPECT_EQ(forces.fx_n, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(EverySoil, WheelLaws, testing::ValuesIn(wheel_specs::all()), title);

}  // namespace

TEST(WheelEdges, TrustEndsAtItsBounds) {
  const WheelModel model(wheel_specs::ishigami2007());
  for (const double slip : {-0.9, 0.0, 0.95}) {
    EXPECT_EQ(at(model, 60, slip, 60).status, WheelStatus::kOk) << slip;
  }
  for (const double slip : {-1.0, -0.91, 0.96, 1.0}) {
    EXPECT_EQ(at(model, 60, slip, 10).status, WheelStatus::kUntrusted) << slip;
  }
  EXPECT_EQ(at(model, 60, 0, 61).status, WheelStatus::kUntrusted);
  EXPECT_EQ(at(model, 60, 0, -61).status, WheelStatus::kUntrusted);
}

TEST(WheelEdges, AtStandstillTheSoilOnlyHoldsTheWheelUp) {
  const WheelModel model(wheel_specs::ishigami2007());
  const WheelForces forces = model.forces(60, {0, 0, 0});
  EXPECT_EQ(forces.status, WheelStatus::kStandstill);
  EXPECT_EQ(forces.torque_nm, 0);
  EXPECT_EQ(forces.fy_n, 0);
  EXPECT_GT(forces.sinkage_m, 0);
}

TEST(WheelEdges, ARimAgainstTheTravelIsTheLockedLimitAlongTheTravel) {
  const WheelModel model(wheel_specs::ishigami2007());
  const WheelForces against = model.forces(60, {1, 0.1, -0.5});
  const WheelForces locked = model.forces(60, {1, 0.1, 0});
  EXPECT_EQ(against.status, WheelStatus::kCounterRotating);
  EXPECT_EQ(against.fx_n, locked.fx_n);
  EXPECT_EQ(against.fy_n, locked.fy_n);
  EXPECT_LT(against.fx_n, 0);
  const WheelForces backward = model.forces(60, {-1, 0.1, 0.5});
  EXPECT_EQ(backward.status, WheelStatus::kCounterRotating);
  EXPECT_EQ(backward.fx_n, -against.fx_n);
  EXPECT_EQ(slip_ratio({1, 0.1, -0.5}), -1);
}

TEST(WheelEdges, ALockedWheelDraggedSidewaysHasOnlySideForce) {
  const WheelModel model(wheel_specs::ishigami2007());
  const WheelForces dragged = model.forces(60, {0, 1, 0});
  ASSERT_TRUE(has_forces(dragged.status));
  EXPECT_EQ(dragged.torque_nm, 0);
  EXPECT_GT(dragged.fy_n, 10);
}

TEST(WheelEdges, SlipSinkageBelowTheAxleIsAnAnswer) {
  WheelModelSpec spec = wheel_specs::yoshida2004();
  spec.soil.c0_m = 0.2;
  const WheelModel model(spec);
  EXPECT_EQ(at(model, 64.7, 0.1, 0).status, WheelStatus::kOk);
  EXPECT_EQ(at(model, 64.7, 0.9, 0).status, WheelStatus::kSinksToAxle);
}

TEST(WheelEdges, CohesionThatWouldCarryTheLoadIsAnAnswer) {
  WheelModelSpec spec = wheel_specs::yoshida2004();
  spec.soil.cohesion_pa = 2e4;
  const WheelForces forces = at(WheelModel(spec), 5, 0.8, 0);
  EXPECT_EQ(forces.status, WheelStatus::kCohesionCarriesLoad);
  EXPECT_FALSE(has_forces(forces.status));
}

TEST(WheelEdges, TheSinkageIsTheSmallestThatCarriesTheLoad) {
  // Fz over the entry angle has its top near 1.2 rad here: every load below it has a second root.
  const WheelModelSpec spec = wheel_specs::all()[2].spec;
  ASSERT_EQ(spec.soil.n, 0.5);
  const WheelModel model(spec);
  double before = 0;
  double load_n = 1;
  for (; load_n < 1000; load_n *= 1.01) {
    const WheelForces forces = at(model, load_n, -0.5, 0);
    if (!has_forces(forces.status)) break;
    EXPECT_GT(forces.theta_f_rad, before);
    EXPECT_LT(forces.theta_f_rad - before, 0.4) << "jumped over the smallest root at " << load_n;
    before = forces.theta_f_rad;
  }
  EXPECT_LT(load_n, 1000);
  for (; load_n < 2000; load_n *= 1.1) {
    EXPECT_EQ(at(model, load_n, -0.5, 0).status, WheelStatus::kSinksToAxle);
  }
}

TEST(WheelEdges, MotionKeepsTheSlipItWasMadeFrom) {
  for (const double slip : {-1.0, -0.4, 0.0, 0.7, 1.0}) {
    for (const double beta : {-1.5, 0.0, 0.2}) {
      EXPECT_NEAR(slip_ratio(motion_at(slip, beta)), slip, 1e-14);
      EXPECT_NEAR(slip_angle_rad(motion_at(slip, beta)), beta, 1e-14);
    }
  }
}

namespace {

/// The field that an error names; empty where there is none.
template <class F>
std::string rejected_field(F f) {
  try {
    f();
  } catch (const ValueError& error) {
    return error.field();
  }
  return "";
}

std::string rejected(double Soil::*member, double value) {
  WheelModelSpec spec = wheel_specs::ishigami2007();
  spec.soil.*member = value;
  return rejected_field([&] { WheelModel model(spec); });
}

}  // namespace

TEST(WheelBadInput, NamesTheFieldThatIsOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(rejected(&Soil::n, 0), "n");
  EXPECT_EQ(rejected(&Soil::n, 2.1), "n");
  EXPECT_EQ(rejected(&Soil::friction_angle_rad, 90 * kDegree), "friction_angle_deg");
  EXPECT_EQ(rejected(&Soil::cohesion_pa, nan), "cohesion_pa");
  EXPECT_EQ(rejected(&Soil::cohesion_pa, -1), "cohesion_pa");
  EXPECT_EQ(rejected(&Soil::lambda, 1.6), "lambda");
  EXPECT_EQ(rejected(&Soil::kx0_m, 0), "kx0_m");
  EXPECT_EQ(rejected(&Soil::a1, 0.6), "a1");
  EXPECT_EQ(rejected(&Soil::kc, -1e6), "kc");
  EXPECT_EQ(rejected(&Soil::n, 1.0), "");
  for (const double width_m : {0.0, -1.0, nan}) {
    WheelModelSpec spec = wheel_specs::ishigami2007();
    spec.wheel.width_m = width_m;
    EXPECT_EQ(rejected_field([&] { WheelModel model(spec); }), "width_m");
  }
  WheelModelSpec spec = wheel_specs::ishigami2007();
  spec.gravity_mps2 = 0;
  EXPECT_EQ(rejected_field([&] { WheelModel model(spec); }), "gravity_mps2");
}

TEST(WheelModel, ALiftedWheelHasNoForces) {
  const WheelForces lifted = WheelModel(wheel_specs::ishigami2007()).forces(0, {1, 0.1, 1.2});
  EXPECT_EQ(lifted.status, WheelStatus::kLifted);
  EXPECT_EQ(name(lifted.status), "lifted");
  EXPECT_EQ(lifted.fx_n, 0);
  EXPECT_EQ(lifted.fy_n, 0);
  EXPECT_EQ(lifted.torque_nm, 0);
  EXPECT_EQ(lifted.sinkage_m, 0);
}

TEST(WheelBadInput, NamesTheConditionThatCannotBe) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  const WheelModel model(wheel_specs::ishigami2007());
  for (const double load_n : {-1.0, nan, inf}) {
    EXPECT_EQ(rejected_field([&] { model.forces(load_n, {1, 0, 1}); }), "load_n");
  }
  EXPECT_EQ(rejected_field([&] { model.forces(60, {nan, 0, 1}); }), "vx_mps");
  EXPECT_EQ(rejected_field([&] { model.forces(60, {1, inf, 1}); }), "vy_mps");
  EXPECT_EQ(rejected_field([&] { model.forces(60, {1, 0, nan}); }), "rim_speed_mps");
  EXPECT_EQ(rejected_field([&] { motion_at(1.01, 0); }), "slip_ratio");
  EXPECT_EQ(rejected_field([&] { motion_at(nan, 0); }), "slip_ratio");
  EXPECT_EQ(rejected_field([&] { motion_at(0, 91 * kDegree); }), "slip_angle_rad");
}

// The claims of the text and of Figs. 6 and 7, at the paper's load.
class PaperClaims : public testing::Test {
 protected:
  static constexpr double kLoad_n = 64.7;
  WheelModel model{wheel_specs::yoshida2004()};

  double fx(double slip, double beta_deg) const { return at(model, kLoad_n, slip, beta_deg).fx_n; }
  double fy(double slip, double beta_deg) const { return at(model, kLoad_n, slip, beta_deg).fy_n; }
  double fc(double slip, double beta_deg) const {
    const double beta = beta_deg * kDegree;
    return fx(slip, beta_deg) * std::sin(beta) + fy(slip, beta_deg) * std::cos(beta);
  }
};

TEST_F(PaperClaims, SideForceRisesWithTheSlipAngleAtEverySlip) {
  for (double slip = 0; slip < 0.99; slip += 0.05) {
    for (double beta_deg = 0; beta_deg < 16; beta_deg += 4) {
      EXPECT_GT(fy(slip, beta_deg + 4), fy(slip, beta_deg)) << slip;
    }
  }
}

TEST_F(PaperClaims, SideForcePeaksNearASlipOfThreeTenthsAndFallsFastBeyondSixTenths) {
  for (const double beta_deg : {4.0, 8.0, 12.0, 16.0}) {
    double best = 0;
    for (double slip = 0; slip <= 1; slip += 0.01) {
      if (fy(slip, beta_deg) > fy(best, beta_deg)) best = slip;
    }
    EXPECT_GE(best, 0.245) << beta_deg;
    EXPECT_LE(best, 0.305) << beta_deg;
    EXPECT_LT(fy(0.8, beta_deg), 0.75 * fy(0.6, beta_deg));
    EXPECT_NEAR(fy(1, beta_deg), 0, 1e-9);
  }
}

TEST_F(PaperClaims, DrawbarPullPeaksThenFallsToSevenTenthsAndDoesNotDependOnTheSlipAngle) {
  double best = 0;
  for (double slip = 0; slip <= 1; slip += 0.01) {
    if (fx(slip, 0) > fx(best, 0)) best = slip;
    for (const double beta_deg : {4.0, 16.0}) EXPECT_EQ(fx(slip, beta_deg), fx(slip, 0));
  }
  EXPECT_NEAR(best, 0.38, 0.03);
  EXPECT_NEAR(fx(1, 0) / fx(best, 0), 0.7, 0.05);
  EXPECT_GT(fx(1, 0), 0);
}

TEST_F(PaperClaims, CorneringForceFallsByMoreThanHalfBetweenSlipsOfSixTenthsAndOne) {
  EXPECT_LT(fc(1, 16), 0.5 * fc(0.6, 16));
}

}  // namespace regoplan
