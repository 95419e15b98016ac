#include "terramech/mechanisms/generic_correction.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "terramech/basics/input_error.h"
#include "terramech/force_table/force_table.h"
#include "terramech/wheel/corrected_forces.h"
#include "tests/terramech/wheel_specs.h"

namespace regoplan {
namespace {

GenericCorrection some_correction() {
  return {.slip_scale = 0.25,
          .slip_angle_scale_rad = 0.15,
          .log_load_scale = 0.6,
          .slip_ratio_region = {-0.4, 0.7},
          .slip_angle_rad_region = {0, 20 * kDegree},
          .load_n_region = {30, 90},
          .fade_share = 0.1,
          .nodes = {{0.0, 0.0, 45, 2, 3, -0.1, 0.001},
                    {0.3, 0.2, 60, -4, 5, 0.3, 0.004},
                    {0.5, 0.1, 70, 1, -2, 0.2, -0.002}}};
}

WheelModelSpec with_correction(WheelModelSpec spec = wheel_specs::ishigami2007()) {
  spec.generic = some_correction();
  return spec;
}

/// Conditions well inside, in the fade, and outside of the region.
struct Place {
  double load_n, slip, beta_deg;
};
const std::vector<Place> kInside{{60, 0.3, 10}, {60, -0.2, 3}, {35, 0.65, 18.5}, {85, -0.35, 0}};
const std::vector<Place> kOutside{
    {60, 0.75, 10}, {60, -0.5, 3}, {60, 0.3, 21}, {29, 0.3, 10}, {91, 0.3, 10}};

TEST(GenericCorrection, IsSilentOutsideItsRegionAndSaysSo) {
  const WheelModel base(wheel_specs::ishigami2007()), corrected(with_correction());
  for (const Place& at : kOutside) {
    const WheelMotion motion = motion_at(at.slip, at.beta_deg * kDegree);
    const WheelForces plain = base.forces(at.load_n, motion);
    const WheelForces forces = corrected.forces(at.load_n, motion);
    EXPECT_EQ(forces.fx_n, plain.fx_n);
    EXPECT_EQ(forces.fy_n, plain.fy_n);
    EXPECT_EQ(forces.torque_nm, plain.torque_nm);
    EXPECT_EQ(forces.sinkage_m, plain.sinkage_m);
    EXPECT_EQ(forces.status, WheelStatus::kOutsideCorrection);
    EXPECT_TRUE(has_forces(forces.status));
  }
}

TEST(GenericCorrection, AddsTheSumOfItsBumpsInside) {
  const GenericCorrection c = some_correction();
  const WheelModel base(wheel_specs::ishigami2007()), corrected(with_correction());
  for (const Place& at : kInside) {
    const WheelMotion motion = motion_at(at.slip, at.beta_deg * kDegree);
    const WheelForces plain = base.forces(at.load_n, motion);
    const WheelForces forces = corrected.forces(at.load_n, motion);
    double fx = 0, fy = 0, torque = 0, sinkage = 0;
    for (const auto& node : c.nodes) {
      const CorrectionBump b = bump(c, node, {at.slip, at.beta_deg * kDegree, at.load_n});
      fx += node.fx_n * b.even;
      fy += node.fy_n * b.side;
      torque += node.torque_nm * b.even;
      sinkage += node.sinkage_m * b.even;
    }
    EXPECT_NEAR(forces.fx_n - plain.fx_n, fx, 1e-12);
    EXPECT_NEAR(forces.fy_n - plain.fy_n, fy, 1e-12);
    EXPECT_NEAR(forces.torque_nm - plain.torque_nm, torque, 1e-12);
    EXPECT_NEAR(forces.sinkage_m - plain.sinkage_m, sinkage, 1e-15);
    EXPECT_NE(forces.fx_n, plain.fx_n);
    EXPECT_EQ(forces.status, WheelStatus::kOk);
  }
}

TEST(GenericCorrection, IsOddInTheSlipAngleOnlyForTheSideForce) {
  const WheelModel model(with_correction());
  for (const Place& at : kInside) {
    const WheelForces left = model.forces(at.load_n, motion_at(at.slip, at.beta_deg * kDegree));
    const WheelForces right = model.forces(at.load_n, motion_at(at.slip, -at.beta_deg * kDegree));
    EXPECT_EQ(right.fy_n, -left.fy_n);
    EXPECT_EQ(right.fx_n, left.fx_n);
    EXPECT_EQ(right.torque_nm, left.torque_nm);
    EXPECT_EQ(right.sinkage_m, left.sinkage_m);
  }
  EXPECT_EQ(model.forces(60, motion_at(0.3, 0)).fy_n, 0);
}

TEST(GenericCorrection, PushesAWheelThatGoesBackwardTheOtherWay) {
  const WheelModel model(with_correction());
  WheelMotion motion = motion_at(0.3, 10 * kDegree);
  const WheelForces forward = model.forces(60, motion);
  motion.vx_mps = -motion.vx_mps;
  motion.rim_speed_mps = -motion.rim_speed_mps;
  const WheelForces backward = model.forces(60, motion);
  EXPECT_EQ(backward.fx_n, -forward.fx_n);
  EXPECT_EQ(backward.torque_nm, -forward.torque_nm);
  EXPECT_EQ(backward.fy_n, forward.fy_n);
}

TEST(GenericCorrection, FadesWithoutAStepAtItsEdgesAndAtSlipAngleZero) {
  const GenericCorrection c = some_correction();
  constexpr double kNear = 1e-7;
  for (const CorrectionPoint& edge :
       {CorrectionPoint{0.7, 0.1, 60}, CorrectionPoint{-0.4, 0.1, 60},
        CorrectionPoint{0.3, 20 * kDegree, 60}, CorrectionPoint{0.3, 0.1, 30},
        CorrectionPoint{0.3, 0.1, 90}}) {
    EXPECT_NEAR(correction_at(c, edge).value.fx_n, 0, 1e-9);
  }
  EXPECT_NEAR(correction_at(c, {0.3, kNear, 60}).value.fy_n, 0, 1e-5);
  EXPECT_GT(std::abs(correction_at(c, {0.3, kNear, 60}).value.fx_n), 0.1);
}

TEST(GenericCorrection, SlopesAreThoseOfItsValues) {
  const GenericCorrection c = some_correction();
  constexpr double kStep = 1e-6;
  const auto expect_slope = [](const CorrectionValue& up, const CorrectionValue& down,
                               const CorrectionValue& slope) {
    for (const auto channel : {&CorrectionValue::fx_n, &CorrectionValue::fy_n,
                               &CorrectionValue::torque_nm, &CorrectionValue::sinkage_m}) {
      const double change = (up.*channel - down.*channel) / (2 * kStep);
      EXPECT_NEAR(slope.*channel, change, 1e-6 * (1 + std::abs(change)));
    }
  };
  const auto value = [&](double slip, double angle, double log_load) {
    return correction_at(c, {slip, angle, std::exp(log_load)}).value;
  };
  for (const Place& at : kInside) {
    const double s = at.slip, b = std::max(at.beta_deg, 0.01) * kDegree, l = std::log(at.load_n);
    const SlopedCorrection sloped = correction_at(c, {s, b, at.load_n});
    expect_slope(value(s + kStep, b, l), value(s - kStep, b, l), sloped.by_slip_ratio);
    expect_slope(value(s, b + kStep, l), value(s, b - kStep, l), sloped.by_slip_angle);
    expect_slope(value(s, b, l + kStep), value(s, b, l - kStep), sloped.by_log_load);
  }
}

TEST(GenericCorrection, ActsOnTopOfMechanismsAndOnRuts) {
  WheelModelSpec digging = wheel_specs::ishigami2007();
  digging.mechanisms = {{"slip_sinkage", "", {}}};
  const WheelMotion motion = motion_at(0.3, 10 * kDegree);
  const WheelChannels plain = WheelModel(digging).channels(60, motion);
  const WheelChannels both = WheelModel(with_correction(digging)).channels(60, motion);
  const CorrectionValue added = correction_at(some_correction(), {0.3, 10 * kDegree, 60}).value;
  EXPECT_NEAR(both.forces.fx_n - plain.forces.fx_n, added.fx_n, 1e-9);
  EXPECT_NEAR(both.rut_left_m - plain.rut_left_m, added.sinkage_m, 1e-12);
  EXPECT_NEAR(both.rut_right_m - plain.rut_right_m, added.sinkage_m, 1e-12);
}

TEST(GenericCorrection, IsAddedToATableAsToTheModelItself) {
  const ForceTable table({.model = with_correction(), .nominal_load_n = 60});
  const ForceTable base({.model = wheel_specs::ishigami2007(), .nominal_load_n = 60});
  EXPECT_NEAR(table.error().at_worst, base.error().at_worst, 1e-9);
  std::vector<double> loads;
  std::vector<WheelMotion> motions;
  for (const auto* places : {&kInside, &kOutside}) {
    for (const Place& at : *places) {
      const WheelMotion motion = motion_at(at.slip, at.beta_deg * kDegree);
      const WheelForces exact = table.direct().forces(at.load_n, motion);
      const WheelForces forces = table.forces(at.load_n, motion);
      EXPECT_EQ(forces.status, exact.status);
      EXPECT_NEAR(forces.fx_n, exact.fx_n, 5e-3 * at.load_n);
      EXPECT_NEAR(forces.fy_n, exact.fy_n, 5e-3 * at.load_n);
      loads.push_back(at.load_n);
      motions.push_back(motion);
    }
  }
  const std::vector<PlaneForces> batch = table.plane_forces(loads, motions);
  for (std::size_t i = 0; i < batch.size(); ++i) {
    EXPECT_EQ(batch[i].fx_n, table.forces(loads[i], motions[i]).fx_n);
  }
}

TEST(GenericCorrection, IsNeverTakenFromOrLeftOutByATableOnDisk) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("correction-test-" + std::to_string(::getpid()));
  const WheelMotion motion = motion_at(0.3, 10 * kDegree);
  const auto fx = [&](const WheelModelSpec& spec) {
    return ForceTable::cached({.model = spec, .nominal_load_n = 60}, folder)
        .forces(60, motion)
        .fx_n;
  };
  const double plain = fx(wheel_specs::ishigami2007());
  const double with = fx(with_correction());
  EXPECT_NEAR(with - plain, correction_at(some_correction(), {0.3, 10 * kDegree, 60}).value.fx_n,
              1e-9);
  EXPECT_EQ(fx(wheel_specs::ishigami2007()), plain);
  std::filesystem::remove_all(folder);
}

/// Against the table without the correction: what the splines round goes out of the difference.
TEST(GenericCorrection, ATablesSlopesAreThoseOfWhatIsAdded) {
  const ForceTable table({.model = with_correction(), .nominal_load_n = 60});
  const ForceTable base({.model = wheel_specs::ishigami2007(), .nominal_load_n = 60});
  constexpr double kStep = 1e-5;
  for (const Place& at : {Place{60, 0.3, 10}, Place{60, -0.2, -8}, Place{35, 0.66, 19}}) {
    for (const double direction : {1.0, -1.0}) {
      WheelMotion motion = motion_at(at.slip, at.beta_deg * kDegree);
      motion.vx_mps *= direction;
      motion.rim_speed_mps *= direction;
      const SlopedForces sloped = table.forces_with_slopes(at.load_n, motion);
      const SlopedForces plain = base.forces_with_slopes(at.load_n, motion);
      EXPECT_NEAR(sloped.fx.value_n, table.forces(at.load_n, motion).fx_n, 1e-9);
      EXPECT_NEAR(sloped.fy.value_n, table.forces(at.load_n, motion).fy_n, 1e-9);
      const auto expect = [&](double load_step, const WheelMotion& step,
                              double SlopedForce::*slope) {
        const auto added = [&](double sign, double WheelForces::*channel) {
          const double load_n = at.load_n + sign * load_step;
          const WheelMotion moved{motion.vx_mps + sign * step.vx_mps,
                                  motion.vy_mps + sign * step.vy_mps,
                                  motion.rim_speed_mps + sign * step.rim_speed_mps};
          return table.forces(load_n, moved).*channel - base.forces(load_n, moved).*channel;
        };
        const auto change = [&](double WheelForces::*channel) {
          return (added(1, channel) - added(-1, channel)) / (2 * kStep);
        };
        const double fx = change(&WheelForces::fx_n), fy = change(&WheelForces::fy_n);
        EXPECT_NEAR(sloped.fx.*slope - plain.fx.*slope, fx, 1e-5 * (1 + std::abs(fx)));
        EXPECT_NEAR(sloped.fy.*slope - plain.fy.*slope, fy, 1e-5 * (1 + std::abs(fy)));
      };
      expect(kStep, {}, &SlopedForce::by_load);
      expect(0, {.vx_mps = kStep}, &SlopedForce::by_vx_nspm);
      expect(0, {.vy_mps = kStep}, &SlopedForce::by_vy_nspm);
      expect(0, {.rim_speed_mps = kStep}, &SlopedForce::by_rim_speed_nspm);
    }
  }
}

TEST(GenericCorrection, NamesTheFieldThatCannotBe) {
  const auto expect_refused = [](auto change, const std::string& field) {
    WheelModelSpec spec = with_correction();
    change(*spec.generic);
    try {
      WheelModel{spec};
      ADD_FAILURE() << field;
    } catch (const ValueError& bad) {
      EXPECT_EQ(bad.field(), field);
    }
  };
  using C = GenericCorrection;
  expect_refused([](C& c) { c.slip_scale = 0; }, "slip_scale");
  expect_refused([](C& c) { c.slip_angle_scale_rad = -1; }, "slip_angle_scale_deg");
  expect_refused([](C& c) { c.log_load_scale = std::nan(""); }, "log_load_scale");
  expect_refused([](C& c) { c.slip_ratio_region = {0.5, 0.1}; }, "region.slip_ratio");
  expect_refused([](C& c) { c.slip_angle_rad_region[0] = -0.1; }, "region.slip_angle_deg");
  expect_refused([](C& c) { c.load_n_region[0] = 0; }, "region.load_n");
  expect_refused([](C& c) { c.fade_share = 0.6; }, "fade_share");
  expect_refused([](C& c) { c.nodes[1].fx_n = INFINITY; }, "fx_n");
  expect_refused([](C& c) { c.nodes[1].load_n = 0; }, "load_n");
}

}  // namespace
}  // namespace regoplan
